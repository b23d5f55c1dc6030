#pragma once
// Scenes and models that several tests share.

#include <string>

#include "live_stiffness/compliance/stiffness_model.h"

namespace live_stiffness {

// config/scenes/paper_one_segment.yaml or paper_two_segments.yaml.
Scene paperScene(int segments);

// The same without gravity.
Scene weightlessPaperScene(int segments);

// The paper's two segments with everything that can be asked of a chain: a heavy link between them, another at the
// end, tip mass off the axis, and gravity oblique to all axes.
Scene awkwardScene();

// config/scenes/stiff_flop_recorded.yaml.
Scene arm();

Segment& segmentOf(Scene& scene, int index);

// Options with the given accuracy, else default.
ModelOptions accurateTo(double accuracy);

// Pressures of the paper: bar times a pattern of six (or twelve) entries.
Pressures bars(double bar, const std::vector<double>& pattern);

// Solves in a fresh workspace.
StiffnessSolution solveCold(const StiffnessModel& model, const Pressures& pressures,
                            const Wrench& tip_wrench = Wrench::Zero());

constexpr Stepping kSteppings[] = {Stepping::kFixedStep, Stepping::kContinuous, Stepping::kLinear};

}  // namespace live_stiffness
