#pragma once
// One element of rod as plain data: no Eigen and no class, because it crosses the border to code that is compiled for
// another instruction set. Rows hold one value per Gauss node and then one for the element's end; matrices are
// row-major, symmetric ones xx xy xz yy yz zz; axes are those of B unless said.

#include "gauss_legendre.h"

namespace live_stiffness {

// Gauss nodes that an element may have. With 3 a rod needs two elements where 5 need one, which costs more at any accuracy.
constexpr int kStageCounts[] = {5, 7};
constexpr int kMaxStages = 7;
typedef double StageRow[kMaxStages + 1] __attribute__((aligned(64)));

// A symmetric 6x6 compliance in 21 numbers: linear block (symmetric), upper right block (3x3), angular block;
// the rest of a row is not used.
constexpr int kPackedSize = 21, kPackedRow = 24;
typedef double PackedRow[kPackedRow] __attribute__((aligned(32)));

// A row of ElementState::dense: density of compliance about the element's start, then tangent p', then rate of g; the
// rest is not used.
constexpr int kDenseTangent = kPackedSize, kDenseRate = kDenseTangent + 3, kDenseRow = 28;

// Sensitivities of an element: derivatives of its sections' state by the moment and the rotation of its start and by a dead
// force at its end, in groups of three columns. A rotation turns the moment with the section, so that the robot as a whole
// turns about its load exactly.
constexpr int kOfMoment = 0, kOfForce = 3, kOfRotation = 6, kColumns = 9;

// Derivatives at the end: rotation phi (rad, R changes by hat(phi) R), position relative to the start, and moment: relative to
// the turned section (mu of docs/derivation.md), of the last element of a chain and of single elements in base axes. The first
// index is the column.
struct ElementTransfer {
  double phi[kColumns][3], p[kColumns][3], m[kColumns][3];
  // [i][j]: the work of the moment of column i on the turning that column j still misses (adjoint-weighted residual). It
  // corrects the compliance to second order in the columns' error.
  double adjoint_residual[kColumns][kColumns];
};

struct ElementState {
  // Where it is.
  int segment;                                // index of the segment it is part of
  double start;                               // arc length of its start from the segment's base, stretched, m
  double p_start[3];                          // position of its first section in B, m

  // Set by the caller.
  double length;                              // stretched, m
  double R_start[9];                          // orientation of its first section
  double n_start[3];                          // N, external loads of everything beyond
  double m_start[3];                          // N m
  double line_load[3];                        // w, N/m
  double shear, elongation;                   // c_se = diag(shear, shear, elongation), 1/N
  double bend_xx, bend_xy, bend_yy, torsion;  // c_bt, 1/(N m^2)
  double rest_curvature[3];                   // u_rest, 1/m, body axes

  // Unknown and guess: Cayley vectors g from the first section to the nodes, R = R_start cayley(g); and their rates,
  // without that at the end.
  StageRow g[3], g_rate[3];

  // Result of the last iteration.
  double R_end[9], n_end[3], m_end[3];
  double change;      // norm of the change of all g in it
  double size;        // norm of all g, before it
  double truncation;      // size of the highest Legendre coefficient of length * g', or what the one below lets expect
  double interior_error;  // estimate of the relative error of the shape between the nodes

  // Shape at the nodes, filled by evaluate(); offsets by place_unloaded(), too.
  StageRow R[9], tangent[3], offset[3];  // orientation, p', position from the start (m)
  StageRow n[3], m[3];
  double offset_end[3];

  // Linearised rod at the nodes, filled by propagate(): length times B, M and P of columns' rates.
  StageRow bend[6], m_of_phi[9], p_of_phi[9];
  double stretch[6];  // integral of S = R c_se R^T, symmetric

  // Sensitivities at the nodes and the end; kept as guess for the next solve. And what phi is the integral of.
  StageRow phi[kColumns][3], dm[kColumns][3], phi_rate[kColumns][3];
  ElementTransfer transfer;       // at the start of the next element: across the rigid links, and the offset of T
  double sensitivity_truncation;  // square of the highest Legendre coefficient of their rate, as it turns the end, relative

  // Of the solution before, what predict() goes on from.
  double turn[3];  // of the rest curvature from there to here, rad
  double R_before[9], m_before[3];
  StageRow g_before[3], phi_before[kColumns][3], phi_rate_before[kColumns][3];

  // Joint at the element's start, docs/derivation.md, section 4: what the end before it and its own start differ by, as a
  // Cayley vector and a moment (N m); and the factors of the last factorise().
  double gap_turn[3], gap_moment[3];  // of the first element nothing
  double stiffness[9];  // S: the moment at the start, by a rotation of it, of everything from here to T
  double pivot_inverse[9];
  double step_moment[3], step_turn[3];  // of the start, in the last Newton step
  double by_wrench[3][8] __attribute__((aligned(32)));  // moment at the start by a unit wrench at T, the start held

  // Plane of an arc: curvature (1/m) and its square, axis in the axes of its start, and in those of B its first direction
  // across, its axis and its first tangent. Set by placeArc().
  double arc_curvature, arc_square, arc_axis[2], arc_q1[3], arc_q2[3], arc_q3[3];

  // Material compliance of the element about its start (of an arc: about its end), and what stations() needs. Filled by
  // placeArc(), exact up to kMaxUnloadedBending, which sets no nodes; or by material(), on a Gauss grid of its own: one
  // row a node.
  PackedRow compliance;
  bool is_arc, unloaded;
  int dense_nodes;
  double dense[kMaxNodes][kDenseRow] __attribute__((aligned(32)));
  double station_error;     // estimate of the relative error of stations()

  // Material compliance of everything before the element's start and end, about these. Set by accumulate().
  PackedRow start_compliance, end_compliance;
};

// Sections inside one element, a batch at a time.
constexpr int kStationBatch = 4;
struct StationBatch {
  int size;   // sections wanted; what is beyond must be set, too, and may repeat one of them
  int nodes;  // which `weight` is for; 0: none yet
  double fraction[kStationBatch] __attribute__((aligned(32)));  // of the element's length, 0 to 1
  // Row j: of the values at node j of an element of length 1 in integrals from its start to the sections. Not for arcs.
  double weight[kMaxNodes][kStationBatch] __attribute__((aligned(32)));
};
// Where the results go, column-major.
struct StationResults {
  double* pose[kStationBatch];        // 12: orientation in B and position, m
  double* compliance[kStationBatch];  // 36: of everything before the section, about it
};

}  // namespace live_stiffness
