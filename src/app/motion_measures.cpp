#include "app/motion_measures.hpp"

#include <fmt/format.h>

#include "motion/history.hpp"
#include "motion/units.hpp"

namespace nsframe::app {

void print_measures(const Record& record) {
  const MotionMeasures m = measure(record.acceleration, record.dt);
  fmt::print("  {} values, dt {:g} s, {:g} s\n", record.acceleration.size(), record.dt,
             record.dt * static_cast<double>(record.acceleration.size() - 1));
  fmt::print("  {:<24} {:>12.5g} m/s2  at {:.3f} s  ({:.4f} g)\n", "PGA", m.acceleration.value, m.acceleration.time,
             m.acceleration.value / in_si(AccelerationUnit::g));
  fmt::print("  {:<24} {:>12.5g} m/s   at {:.3f} s\n", "PGV", m.velocity.value, m.velocity.time);
  fmt::print("  {:<24} {:>12.5g} m     at {:.3f} s\n", "PGD", m.displacement.value, m.displacement.time);
  fmt::print("  {:<24} {:>12.5g} m/s\n", "Arias intensity", m.arias);
  fmt::print("  {:<24} {:>12.5g} s     from {:.3f} to {:.3f} s\n", "duration D5-75", m.significant_75(), m.from_5,
             m.to_75);
  fmt::print("  {:<24} {:>12.5g} s     from {:.3f} to {:.3f} s\n", "duration D5-95", m.significant_95(), m.from_5,
             m.to_95);
  fmt::print("  {:<24} {:>12.5g} m/s, {:.5g} m\n", "at the end", m.final_velocity, m.final_displacement);
}

nlohmann::json measures_json(const Record& record, const std::string& file) {
  const MotionMeasures m = measure(record.acceleration, record.dt);
  return {{"file", file},
          {"format", record.format},
          {"description", record.description},
          {"notes", record.notes},
          {"samples", record.acceleration.size()},
          {"dt", record.dt},
          {"pga", m.acceleration.value},
          {"pga_time", m.acceleration.time},
          {"pgv", m.velocity.value},
          {"pgv_time", m.velocity.time},
          {"pgd", m.displacement.value},
          {"pgd_time", m.displacement.time},
          {"arias", m.arias},
          {"t5", m.from_5},
          {"t75", m.to_75},
          {"t95", m.to_95},
          {"d5_75", m.significant_75()},
          {"d5_95", m.significant_95()},
          {"final_velocity", m.final_velocity},
          {"final_displacement", m.final_displacement}};
}

}  // namespace nsframe::app
