#pragma once
// What a CSV recording is, for --help of the programs that read one. docs/recordings.md says more.

#include <string>

namespace live_stiffness {

inline const std::string kRecordingHelp =
    "Columns of a CSV recording, in any order (docs/recordings.md):\n"
    "  time_s                                increasing; or time_ms\n"
    "  pressure_1_pa, pressure_2_pa, ...     gauge; or in kpa, bar, mbar, psi\n"
    "  pressure_1_pa_abs, ...                instead: absolute, the robot at rest in the first 0.5 s\n"
    "  tip_x_m, tip_y_m, tip_z_m             the tracker's sensor on the tip; or in mm\n"
    "  tip_qw, tip_qx, tip_qy, tip_qz        its orientation, if it is measured\n"
    "  base_x_m, base_y_m, base_z_m          optional: a sensor at the base; or in mm\n"
    "  base_qw, base_qx, base_qy, base_qz    optional: its orientation\n"
    "  force_x_n, force_y_n, force_z_n,\n"
    "  torque_x_nm, torque_y_nm, torque_z_nm optional: a force sensor on the tip, in its own axes\n\n";

}  // namespace live_stiffness
