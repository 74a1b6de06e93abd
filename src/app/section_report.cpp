// The answers of `nsframe section` as a table, JSON and CSV.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "app/section.hpp"

namespace nsframe::app {

namespace {

double degrees(double angle) { return angle * 180 / pi; }

// What the fibers of a material are called in a table's heads: no commas.
std::string column(const std::string& material) {
  std::string out = material;
  for (char& c : out)
    if (c == ',' || c == '"' || c == '\n') c = '_';
  return out;
}

void print_point(const char* what, const BendingPoint& point, const std::string& remark) {
  fmt::print("  {:<28} {:>12.5g} {:>14.5g} {:>14.5g}   {}\n", what, point.curvature, point.moment / 1e3,
             point.curvature == 0 ? 0 : point.moment / point.curvature / 1e3, remark);
}

std::string strains(const SectionReport& report, const BendingState& state) {
  std::string out;
  for (std::size_t i = 0; i < report.section.parts.size(); ++i)
    out += fmt::format("{}{} {:.3f} to {:.3f} %", out.empty() ? "" : ", ", report.section.parts[i].material,
                       100 * state.strain[i][0], 100 * state.strain[i][1]);
  return out;
}

void print_curve(const SectionReport& report) {
  const MomentCurvature& curve = report.curve;
  const BendingSummary& s = report.summary;
  fmt::print("moment and curvature about {:g} deg (0: z, 90: y) under N = {:g} kN, {} across\n", degrees(report.angle),
             report.axial_force / 1e3, report.free_axis ? "no moment" : "no curvature");
  fmt::print("  {:<28} {:>12} {:>14} {:>14}\n", "", "kappa [1/m]", "M [kN m]", "M/kappa [kN m2]");
  for (std::size_t i = 0; i < s.first_yield.size(); ++i) {
    if (s.first_yield[i])
      print_point(fmt::format("first yield of {}", report.section.parts[i].material).c_str(), *s.first_yield[i], "");
  }
  print_point("largest moment", s.peak, "");
  if (!report.cyclic) {
    print_point("last", s.ultimate, s.fallen ? "the moment has fallen to 0.8 of the largest" : "");
    if (s.yield && s.yield->curvature != 0)
      fmt::print("  curvature ductility, last over first yield: {:.3g}\n", s.ultimate.curvature / s.yield->curvature);
  }
  fmt::print("  strains at the end: {}\n", strains(report, curve.states.back()));
  if (!curve.end.empty()) fmt::print("  ended early: {}\n", curve.end);
}

// The points of largest moment, and of axial force alone.
void print_interaction(const SectionReport& report) {
  fmt::print("interaction at the strain limits:");
  for (std::size_t i = 0; i < report.limits.size(); ++i)
    fmt::print(" {} -{:g} to {:g}{}", report.section.parts[i].material, report.limits[i].shortening,
               report.limits[i].elongation, i + 1 < report.limits.size() ? "," : "\n");
  fmt::print("  {:>10} {:>16} {:>16} {:>16} {:>16} {:>16}\n", "angle [deg]", "N short [kN]", "N long [kN]", "M at N = 0",
             "largest M [kN m]", "its N [kN]");
  for (const InteractionCurve& curve : report.interaction) {
    const InteractionPoint* largest = &curve.points.front();
    double at_zero = std::nan("");
    for (std::size_t i = 0; i < curve.points.size(); ++i) {
      const InteractionPoint& p = curve.points[i];
      if (p.moment > largest->moment) largest = &p;
      if (i == 0) continue;
      const InteractionPoint& before = curve.points[i - 1];
      if (before.force[0] <= 0 && p.force[0] > 0)
        at_zero = before.moment - before.force[0] / (p.force[0] - before.force[0]) * (p.moment - before.moment);
    }
    fmt::print("  {:>10.4g} {:>16.6g} {:>16.6g} {:>16.6g} {:>16.6g} {:>16.6g}\n", degrees(curve.angle),
               curve.points.front().force[0] / 1e3, curve.points.back().force[0] / 1e3, at_zero / 1e3,
               largest->moment / 1e3, largest->force[0] / 1e3);
  }
}

nlohmann::json point_json(const BendingPoint& point) { return {{"curvature", point.curvature}, {"moment", point.moment}}; }

nlohmann::json curve_json(const SectionReport& report) {
  const BendingSummary& s = report.summary;
  nlohmann::json rows = nlohmann::json::array();
  for (const BendingState& state : report.curve.states) {
    rows.push_back({{"curvature", state.curvature},
                    {"moment", state.moment},
                    {"transverse_moment", state.transverse_moment},
                    {"deformation", {state.deformation[0], state.deformation[1], state.deformation[2]}},
                    {"force", {state.force[0], state.force[1], state.force[2]}},
                    {"strain", state.strain}});
  }
  nlohmann::json yields = nlohmann::json::object();
  for (std::size_t i = 0; i < s.first_yield.size(); ++i)
    if (s.first_yield[i]) yields[report.section.parts[i].material] = point_json(*s.first_yield[i]);
  nlohmann::json out{{"axial_force", report.axial_force}, {"angle", report.angle}, {"free_axis", report.free_axis},
                     {"cyclic", report.cyclic},           {"end", report.curve.end}, {"first_yield", yields},
                     {"peak", point_json(s.peak)},        {"rows", rows}};
  if (!report.cyclic) {
    out["ultimate"] = point_json(s.ultimate);
    out["ultimate"]["fallen"] = s.fallen;
  }
  return out;
}

nlohmann::json interaction_json(const SectionReport& report) {
  nlohmann::json curves = nlohmann::json::array();
  for (const InteractionCurve& curve : report.interaction) {
    nlohmann::json points = nlohmann::json::array();
    for (const InteractionPoint& p : curve.points) {
      points.push_back({{"axial_force", p.force[0]},
                        {"moment", p.moment},
                        {"transverse_moment", p.transverse_moment},
                        {"Mz", p.force[1]},
                        {"My", p.force[2]},
                        {"deformation", {p.deformation[0], p.deformation[1], p.deformation[2]}},
                        {"governing", report.section.parts[static_cast<std::size_t>(p.governing)].material}});
    }
    curves.push_back({{"angle", curve.angle}, {"points", points}});
  }
  return curves;
}

}  // namespace

void print_section(const SectionReport& report) {
  const FiberSection& fibers = report.section.fibers;
  const Matrix3 k = initial_tangent(fibers);
  fmt::print("section '{}': {} fibers\n", report.section.name, fibers.fibers);
  for (const SectionPart& part : report.section.parts)
    fmt::print("  {:<20} {:>6} fibers, {:>10.5g} cm2\n", part.material, part.points.size(), 1e4 * part.area);
  fmt::print("  EA = {:.6g} kN, EIz = {:.6g} kN m2, EIy = {:.6g} kN m2, GJ = {:.6g} kN m2\n", k(0, 0) / 1e3, k(1, 1) / 1e3,
             k(2, 2) / 1e3, fibers.torsion_stiffness / 1e3);
  print_curve(report);
  if (!report.interaction.empty()) print_interaction(report);
}

std::string section_json(const SectionReport& report) {
  const Matrix3 k = initial_tangent(report.section.fibers);
  nlohmann::json tangent = nlohmann::json::array();
  for (int i = 0; i < 3; ++i) tangent.push_back({k(i, 0), k(i, 1), k(i, 2)});
  nlohmann::json parts = nlohmann::json::array();
  for (const SectionPart& part : report.section.parts)
    parts.push_back({{"material", part.material}, {"fibers", part.points.size()}, {"area", part.area}});
  nlohmann::json out{{"section", report.section.name},
                     {"fibers", report.section.fibers.fibers},
                     {"initial_tangent", tangent},
                     {"GJ", report.section.fibers.torsion_stiffness},
                     {"materials", parts},
                     {"moment_curvature", curve_json(report)}};
  if (!report.interaction.empty()) {
    out["interaction"] = interaction_json(report);
    for (std::size_t i = 0; i < report.limits.size(); ++i)
      out["strain_limits"][report.section.parts[i].material] = {-report.limits[i].shortening, report.limits[i].elongation};
  }
  return out.dump(1);
}

std::string moment_curvature_csv(const SectionReport& report) {
  std::string out = "curvature [1/m],moment [N m],transverse moment [N m],axial strain,kz [1/m],ky [1/m],N [N],Mz [N m],My [N m]";
  for (const SectionPart& part : report.section.parts)
    out += fmt::format(",smallest strain of {0},largest strain of {0}", column(part.material));
  out += "\n";
  for (const BendingState& s : report.curve.states) {
    out += fmt::format("{},{},{},{},{},{},{},{},{}", s.curvature, s.moment, s.transverse_moment, s.deformation[0],
                       s.deformation[1], s.deformation[2], s.force[0], s.force[1], s.force[2]);
    for (const auto& [low, high] : s.strain) out += fmt::format(",{},{}", low, high);
    out += "\n";
  }
  return out;
}

std::string interaction_csv(const SectionReport& report) {
  std::string out = "angle [rad],N [N],moment [N m],transverse moment [N m],Mz [N m],My [N m],axial strain,kz [1/m],ky [1/m],governing\n";
  for (const InteractionCurve& curve : report.interaction) {
    for (const InteractionPoint& p : curve.points)
      out += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", curve.angle, p.force[0], p.moment, p.transverse_moment, p.force[1],
                         p.force[2], p.deformation[0], p.deformation[1], p.deformation[2],
                         column(report.section.parts[static_cast<std::size_t>(p.governing)].material));
  }
  return out;
}

}  // namespace nsframe::app
