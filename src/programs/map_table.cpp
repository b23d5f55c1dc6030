#include "map_table.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>


namespace live_stiffness {
namespace {

std::FILE* opened(const std::string& path, std::unique_ptr<PartFile>& part) {
  if (path == "-") return stdout;
  part = std::make_unique<PartFile>(path);
  std::FILE* file = std::fopen(part->writePath().c_str(), "wb");
  if (!file) throw ConfigurationError("output " + path, {writeFault(path)});
  return file;
}

std::vector<std::string> valueNames(const StiffnessCriterion& criterion) {
  std::vector<std::string> names = {"x_m", "y_m", "z_m", "qw", "qx", "qy", "qz"};
  for (int i = 1; i <= 6; ++i) names.push_back("eta_" + std::to_string(i) + "_n");
  names.push_back(std::string(criterion.unit()) == "N" ? "tau_n" : "tau_n_per_m");
  return names;
}

std::string pressureName(int chamber) { return "p_" + std::to_string(chamber + 1) + "_pa"; }

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

MapTable::MapTable(const std::string& csv_path, const std::string& npy_path, const PressurePlan& plan,
                   const StiffnessCriterion& criterion)
    : plan_(plan) {
  csv_ = opened(csv_path, csv_part_);
  std::string header, fields;
  for (int k = 0; k < plan.channels().chamberCount(); ++k) {
    header += pressureName(k) + ",";
    fields += "('" + pressureName(k) + "', '<f8'), ";
  }
  header += "status";
  fields += "('status', '<f8')";
  for (const std::string& name : valueNames(criterion)) {
    header += "," + name;
    fields += ", ('" + name + "', '<f8')";
  }
  std::fprintf(csv_, "%s\n", header.c_str());
  if (npy_path.empty()) return;
  npy_ = opened(npy_path, npy_part_);
  // NumPy's format 1.0: magic, version, length of what follows, a Python literal padded to 64 bytes.
  std::string literal =
      "{'descr': [" + fields + "], 'fortran_order': False, 'shape': (" + std::to_string(plan.rows()) + ",), }";
  literal.append(63 - (10 + literal.size()) % 64, ' ');
  literal += '\n';
  const unsigned char start[] = {0x93, 'N', 'U', 'M', 'P', 'Y', 1, 0, static_cast<unsigned char>(literal.size() & 255),
                                 static_cast<unsigned char>(literal.size() >> 8)};
  std::fwrite(start, 1, sizeof start, npy_);
  std::fwrite(literal.data(), 1, literal.size(), npy_);
}

MapTable::~MapTable() {
  if (csv_ && csv_ != stdout) std::fclose(csv_);
  if (npy_ && npy_ != stdout) std::fclose(npy_);
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
  for (const std::string& text : texts) std::fwrite(text.data(), 1, text.size(), csv_);
  if (npy_) writeArray(first, rows);
}

// Status as its number; values of a failed row NaN, since an array has no empty fields. Little-endian, as the machine.
void MapTable::writeArray(long first, const std::vector<SweepRow>& rows) {
  const int chambers = plan_.channels().chamberCount(), width = chambers + 1 + kValues;
  std::vector<double> block(rows.size() * width, std::numeric_limits<double>::quiet_NaN());
  for (size_t i = 0; i < rows.size(); ++i) {
    double* out = &block[i * width];
    plan_.chamberPressures(first + static_cast<long>(i), Eigen::Map<Pressures>(out, chambers));
    out[chambers] = static_cast<double>(rows[i].code);
    if (rows[i].code == SolveCode::kOk) valuesOf(rows[i], out + chambers + 1);
  }
  std::fwrite(block.data(), sizeof(double), block.size(), npy_);
}

void MapTable::close() {
  bool good = true;
  for (std::FILE* file : {csv_, npy_})
    if (file) good = std::fflush(file) == 0 && !std::ferror(file) && good;
  if (!good) throw ConfigurationError("output", {"could not be written in full: is the disk full?"});
  for (const auto* part : {&csv_part_, &npy_part_})
    if (*part) (*part)->finish();
}

}  // namespace live_stiffness
