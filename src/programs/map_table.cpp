#include "map_table.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>

namespace live_stiffness {
namespace {

constexpr int kValues = 14;  // columns after the status

void append(std::string& text, double value) {
  char digits[32];
  const int size = std::snprintf(digits, sizeof digits, "%.10g", value);  // beyond the accuracy of the solve
  text.append(digits, size);
}

void appendValues(const SweepRow& row, std::string& text) {
  const Eigen::Quaterniond q(row.X_BT.R);
  const auto add = [&](double value) { text += ',', append(text, value); };
  for (int k = 0; k < 3; ++k) add(row.X_BT.p[k]);
  for (double value : {q.w(), q.x(), q.y(), q.z()}) add(value);
  for (int k = 0; k < 6; ++k) add(row.eigenstiffnesses[k]);
  add(row.tau);
}

}  // namespace

MapTable::MapTable(const std::string& path, const PressurePlan& plan, const StiffnessCriterion& criterion) : plan_(plan) {
  if (path != "-") {
    part_ = std::make_unique<PartFile>(path);
    file_ = std::fopen(part_->writePath().c_str(), "w");
    if (file_ == nullptr) throw ConfigurationError("output " + path, {writeFault(path)});
  }
  for (int k = 1; k <= plan.channels().chamberCount(); ++k) std::fprintf(file_, "p_%d_pa,", k);
  std::fputs("status,x_m,y_m,z_m,qw,qx,qy,qz,", file_);
  for (int i = 1; i <= 6; ++i) std::fprintf(file_, "eta_%d_n,", i);
  std::fputs(std::string(criterion.unit()) == "N" ? "tau_n\n" : "tau_n_per_m\n", file_);
}

MapTable::~MapTable() {
  if (part_ != nullptr) std::fclose(file_);
}

std::string MapTable::textOf(long first, const std::vector<SweepRow>& rows, size_t begin, size_t end) const {
  std::string text;
  Pressures chambers(plan_.channels().chamberCount());
  for (size_t i = begin; i != end; ++i) {
    plan_.chamberPressures(first + static_cast<long>(i), chambers);
    for (int k = 0; k < chambers.size(); ++k) append(text, chambers[k]), text += ',';
    text += codeName(rows[i].code);
    if (rows[i].code == SolveCode::kOk) appendValues(rows[i], text);
    else text.append(kValues, ',');
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
