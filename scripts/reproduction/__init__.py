"""Recomputes figures and tables of Shi et al. (IJRR 2024); run by scripts/reproduce."""
