#include "map_table.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>

namespace live_stiffness {
namespace {

std::vector<std::string> valueNames(const StiffnessCriterion& criterion) {
  std::vector<std::string> names = {"x_m", "y_m", "z_m", "qw", "qx", "qy", "qz"};
  for (int i = 1; i <= 6; ++i) names.push_back("eta_" + std::to_string(i) + "_n");
  names.push_back(std::string(criterion.unit()) == "N" ? "tau_n" : "tau_n_per_m");
  return names;
}

constexpr int kValues = 14;

void valuesOf(const SweepRow& row, double* out) {
  const Eigen::Quaterniond q(row.X_BT.R);
  const double pose[] = {row.X_BT.p.x(), row.X_BT.p.y(), row.X_BT.p.z(), q.w(), q.x(), q.y(), q.z()};
  std::copy(pose, pose + 7, out);
  std::copy(row.eigenstiffnesses.data(), row.eigenstiffnesses.data() + 6, out + 7);
  out[13] = row.tau;
}

void append(std::string& text, double value) {
  char digits[32];
  const int size = std::snprintf(digits, sizeof digits, "%.10g", value);  // beyond the accuracy of the solve
  text.append(digits, size);
}

}  // namespace

MapTable::MapTable(const std::string& path, const PressurePlan& plan, const StiffnessCriterion& criterion) : plan_(plan) {
  if (path != "-") {
    part_ = std::make_unique<PartFile>(path);
    file_ = std::fopen(part_->writePath().c_str(), "w");
    if (file_ == nullptr) throw ConfigurationError("output " + path, {writeFault(path)});
  }
  for (int k = 1; k <= plan.channels().chamberCount(); ++k) std::fprintf(file_, "p_%d_pa,", k);
  std::fputs("status", file_);
  for (const std::string& name : valueNames(criterion)) std::fprintf(file_, ",%s", name.c_str());
  std::fputc('\n', file_);
}

MapTable::~MapTable() {
  if (part_ != nullptr) std::fclose(file_);
}

std::string MapTable::textOf(long first, const std::vector<SweepRow>& rows, size_t begin, size_t end) const {
  std::string text;
  Pressures chambers(plan_.channels().chamberCount());
  double values[kValues];
  for (size_t i = begin; i != end; ++i) {
    plan_.chamberPressures(first + static_cast<long>(i), chambers);
    for (int k = 0; k < chambers.size(); ++k) append(text, chambers[k]), text += ',';
    text += codeName(rows[i].code);
    if (rows[i].code == SolveCode::kOk) {
      valuesOf(rows[i], values);
      for (double value : values) text += ',', append(text, value);
    } else {
      text.append(kValues, ',');
    }
    text += '\n';
  }
  return text;
}

void MapTable::write(long first, const std::vector<SweepRow>& rows) {
  constexpr size_t kPart = 512;
  std::vector<std::string> texts((rows.size() + kPart - 1) / kPart);
  tbb::parallel_for(size_t{0}, texts.size(), [&](size_t part) {
    texts[part] = textOf(first, rows, part * kPart, std::min(rows.size(), (part + 1) * kPart));
  });
  for (const std::string& text : texts) std::fwrite(text.data(), 1, text.size(), file_);
}

void MapTable::close() {
  if (std::fflush(file_) != 0 || std::ferror(file_))
    throw ConfigurationError("output", {"could not be written in full: is the disk full?"});
  if (part_ != nullptr) part_->finish();
}

}  // namespace live_stiffness
