#include "app/workstation/calibrate/input/survey_file.h"

#include <fmt/format.h>

#include <cmath>
#include <span>
#include <utility>

#include "app/workstation/calibrate/input/csv_table.h"

namespace dottrack::calibrate {
namespace {

constexpr std::size_t kLeastSeeds = 4;
const std::string kSurveyHeadings = "dot,x_m,y_m,z_m (or _cm, _mm)";
const std::string kPlaceHeadings = "camera,x_m,y_m,z_m (or _cm, _mm)";
const std::string kSeedHeadings = "camera,dot,x_px,y_px";

struct Axes {
  CsvTable::Length x, y, z;

  Eigen::Vector3d at(CsvTable& table, std::size_t row) const {
    const double x_m = table.metres(row, x);
    const double y_m = table.metres(row, y);
    return {x_m, y_m, table.metres(row, z)};
  }
};

std::optional<Axes> axes_of(const CsvTable& table, const std::string& prefix) {
  const auto x = table.length(prefix + "x");
  const auto y = table.length(prefix + "y");
  const auto z = table.length(prefix + "z");
  if (!x || !y || !z) return std::nullopt;
  return Axes{*x, *y, *z};
}

tl::unexpected<Error> headings_missing(const std::filesystem::path& path, const CsvTable& table,
                                       const std::string& expected) {
  const bool no_unit = table.has("x") || table.has("y") || table.has("z");
  return fail(fmt::format("{}: {}; expected the headings {}", path.string(),
                          no_unit ? "coordinates without a unit" : "headings are missing",
                          expected));
}

class SurveyReader {
 public:
  explicit SurveyReader(CsvTable& table) : table_(table) {}

  bool has_headings() const { return name_.has_value() && axes_.has_value(); }

  std::vector<SurveyedDot> read() {
    std::vector<SurveyedDot> dots;
    for (std::size_t row = 0; row < table_.rows(); ++row) dots.push_back(read_dot(row));
    return dots;
  }

 private:
  SurveyedDot read_dot(std::size_t row) {
    SurveyedDot dot;
    dot.name = table_.text(row, *name_);
    if (dot.name.empty()) table_.complain(row, "a dot without a name", "a name or a number");
    dot.position_m = axes_->at(table_, row);
    if (sigmas_) dot.sigma_m = sigmas_->at(table_, row);
    if (sigma_) dot.sigma_m.setConstant(table_.metres(row, *sigma_));
    if (dot.sigma_m.minCoeff() < 0.0) {
      table_.complain(row, "a sigma below 0", "0 (exact) or more");
    }
    if (diameter_ && !table_.text(row, diameter_->column).empty()) {
      dot.diameter_m = table_.metres(row, *diameter_);
      if (dot.diameter_m < 0.0) table_.complain(row, "a diameter below 0", "0 (unknown) or more");
    }
    read_normal(row, dot);
    if (tick_ && !table_.text(row, *tick_).empty()) dot.tick = table_.whole_number(row, *tick_);
    check_once(row, dot);
    return dot;
  }

  void read_normal(std::size_t row, SurveyedDot& dot) {
    constexpr double kUnitTolerance = 0.01;
    if (!nx_ || !ny_ || !nz_ || table_.text(row, *nx_).empty()) return;
    const double x = table_.number(row, *nx_);
    const double y = table_.number(row, *ny_);
    const Eigen::Vector3d normal(x, y, table_.number(row, *nz_));
    if (std::abs(normal.norm() - 1.0) > kUnitTolerance) {
      table_.complain(row, fmt::format("nx,ny,nz is a vector of length {:.4g}", normal.norm()),
                      "a unit vector, or left empty");
      return;
    }
    dot.normal = normal.normalized();
  }

  void check_once(std::size_t row, const SurveyedDot& dot) {
    const auto [same, fresh] = lines_.emplace(std::pair(dot.name, dot.tick), table_.line(row));
    if (fresh) return;
    table_.complain(
        row,
        fmt::format("dot {} again, first on line {}", config::in_quotes(dot.name), same->second),
        "every dot once, or once a tick");
  }

  CsvTable& table_;
  std::optional<std::size_t> name_ = table_.column({"dot", "id", "name", "label"});
  std::optional<Axes> axes_ = axes_of(table_, "");
  std::optional<CsvTable::Length> sigma_ = table_.length("sigma");
  std::optional<Axes> sigmas_ = axes_of(table_, "sigma_");
  std::optional<CsvTable::Length> diameter_ = table_.length("diameter");
  std::optional<std::size_t> nx_ = table_.column({"nx"});
  std::optional<std::size_t> ny_ = table_.column({"ny"});
  std::optional<std::size_t> nz_ = table_.column({"nz"});
  std::optional<std::size_t> tick_ = table_.column({"tick"});
  std::map<std::pair<std::string, std::optional<std::size_t>>, std::size_t> lines_;
};

}  // namespace

Result<std::vector<SurveyedDot>> read_survey(const std::filesystem::path& path) {
  auto table = CsvTable::read(path, kSurveyHeadings);
  if (!table) return tl::unexpected<Error>(table.error());
  SurveyReader reader(*table);
  if (!reader.has_headings()) return headings_missing(path, *table, kSurveyHeadings);
  auto dots = reader.read();
  if (!table->complaint().empty()) return tl::unexpected<Error>(table->complaint().first());
  return dots;
}

Result<std::map<std::string, Eigen::Vector3d>> read_places(const std::filesystem::path& path) {
  auto table = CsvTable::read(path, kPlaceHeadings);
  if (!table) return tl::unexpected<Error>(table.error());
  const auto name = table->column({"camera", "name"});
  const auto axes = axes_of(*table, "");
  if (!name || !axes) return headings_missing(path, *table, kPlaceHeadings);
  std::map<std::string, Eigen::Vector3d> places;
  for (std::size_t row = 0; row < table->rows(); ++row) {
    const std::string& camera = table->text(row, *name);
    if (!places.emplace(camera, axes->at(*table, row)).second) {
      table->complain(row, fmt::format("camera {} again", config::in_quotes(camera)),
                      "every camera once");
    }
  }
  if (!table->complaint().empty()) return tl::unexpected<Error>(table->complaint().first());
  return places;
}

Result<std::map<std::string, std::vector<Seed>>> read_seeds(const std::filesystem::path& path,
                                                            std::span<const SurveyedDot> dots) {
  auto table = CsvTable::read(path, kSeedHeadings);
  if (!table) return tl::unexpected<Error>(table.error());
  const auto camera = table->column({"camera"});
  const auto name = table->column({"dot", "id", "name", "label"});
  const auto x = table->column({"x_px", "x"});
  const auto y = table->column({"y_px", "y"});
  const auto tick = table->column({"tick"});
  if (!camera || !name || !x || !y) return headings_missing(path, *table, kSeedHeadings);
  std::map<std::string, std::vector<Seed>> seeds;
  for (std::size_t row = 0; row < table->rows(); ++row) {
    std::optional<std::size_t> at;
    if (tick && !table->text(row, *tick).empty()) at = table->whole_number(row, *tick);
    const std::string& dot = table->text(row, *name);
    std::size_t i = 0;
    while (i < dots.size() && (dots[i].name != dot || (at && dots[i].tick != at))) ++i;
    if (i == dots.size()) {
      table->complain(row, fmt::format("dot {}", config::in_quotes(dot)), "a dot of the survey");
    }
    const double x_px = table->number(row, *x);
    seeds[table->text(row, *camera)].push_back({i, {x_px, table->number(row, *y)}});
  }
  if (!table->complaint().empty()) return tl::unexpected<Error>(table->complaint().first());
  for (const auto& [name_of, of_camera] : seeds) {
    if (of_camera.size() >= kLeastSeeds) continue;
    return fail(fmt::format("{}: {} of camera {}; expected four or more, of places far apart",
                            path.string(), of_camera.size() == 1 ? "one seed" : "too few seeds",
                            config::in_quotes(name_of)));
  }
  return seeds;
}

}  // namespace dottrack::calibrate
