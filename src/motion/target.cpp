#include "motion/target.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "base/errors.hpp"
#include "motion/record.hpp"
#include "motion/text_table.hpp"
#include "spectra/oscillators.hpp"
#include "spectra/spectrum.hpp"

namespace nsframe {

namespace {

struct Corners {
  double s, tb, tc, td;  // soil factor [-], [s]
};

// EN 1998-1:2004, tables 3.2 and 3.3, grounds A to E.
constexpr Corners type1[]{{1.0, 0.15, 0.4, 2.0},
                          {1.2, 0.15, 0.5, 2.0},
                          {1.15, 0.20, 0.6, 2.0},
                          {1.35, 0.20, 0.8, 2.0},
                          {1.4, 0.15, 0.5, 2.0}};
constexpr Corners type2[]{{1.0, 0.05, 0.25, 1.2},
                          {1.35, 0.05, 0.25, 1.2},
                          {1.5, 0.10, 0.25, 1.2},
                          {1.8, 0.10, 0.30, 1.2},
                          {1.6, 0.05, 0.25, 1.2}};

void positive(double value, const char* name) {
  if (!(value > 0) || !std::isfinite(value))
    throw InputError(fmt::format("error: {} of a target spectrum must be positive", name));
}

void check_damping(double damping) {
  if (!(damping > 0 && damping < 1)) throw InputError("error: the damping of a target spectrum must lie in (0, 1)");
}

}  // namespace

TargetSpectrum eurocode8(const Eurocode8& p) {
  if (p.type != 1 && p.type != 2) throw InputError("error: Eurocode 8 has spectra of type 1 and 2");
  if (p.ground < 'A' || p.ground > 'E') throw InputError("error: Eurocode 8 has grounds A, B, C, D and E");
  positive(p.ag, "ag");
  check_damping(p.damping);
  const Corners c = (p.type == 1 ? type1 : type2)[p.ground - 'A'];
  const double eta = std::max(std::sqrt(10 / (5 + 100 * p.damping)), 0.55), s = p.ag * c.s;
  return {fmt::format("Eurocode 8 type {}, ground {}, ag = {:g} m/s2", p.type, p.ground, p.ag), p.damping, 0, 4,
          [=](double t) {
            if (t <= c.tb) return s * (1 + t / c.tb * (2.5 * eta - 1));
            if (t <= c.tc) return 2.5 * eta * s;
            if (t <= c.td) return 2.5 * eta * s * c.tc / t;
            return 2.5 * eta * s * c.tc * c.td / (t * t);
          }};
}

TargetSpectrum asce7(const Asce7& p) {
  positive(p.sds, "SDS");
  positive(p.sd1, "SD1");
  positive(p.tl, "TL");
  const double ts = p.sd1 / p.sds, t0 = 0.2 * ts;
  if (p.tl < ts) throw InputError("error: TL of an ASCE 7 spectrum must not be below SD1 / SDS");
  TargetSpectrum out{fmt::format("ASCE 7, SDS = {:g} m/s2, SD1 = {:g} m/s2", p.sds, p.sd1),
                     0.05,
                     0,
                     std::numeric_limits<double>::infinity(),
                     {}};
  out.acceleration = [=](double t) {
    if (t < t0) return p.sds * (0.4 + 0.6 * t / t0);
    if (t <= ts) return p.sds;
    if (t <= p.tl) return p.sd1 / t;
    return p.sd1 * p.tl / (t * t);
  };
  return out;
}

TargetSpectrum target_table(const std::filesystem::path& file, std::optional<AccelerationUnit> unit, double damping) {
  check_damping(damping);
  const TextTable table = read_text_table(file, 2);
  if (table.unit && unit && *table.unit != *unit)
    throw RecordError({}, fmt::format("'{}' is in units of {}, not {}", file.filename().string(), name_of(*table.unit),
                                      name_of(*unit)));
  if (!table.unit && !unit)
    throw RecordError({}, fmt::format("'{}' doesn't say its unit: --target-unit with one of {}",
                                      file.filename().string(), known_acceleration_units()));
  std::vector<double> periods, values;
  for (const TextTable::Row& row : table.rows) {
    const Location at{file.string(), row.line, 1};
    if (!(row.values[0] >= 0) || (!periods.empty() && row.values[0] <= periods.back()))
      throw RecordError(at, "periods must rise, from 0 or more");
    if (!(row.values[1] > 0)) throw RecordError(at, "pseudo-accelerations must be positive");
    periods.push_back(row.values[0]);
    values.push_back(row.values[1] * in_si(table.unit ? *table.unit : *unit));
  }
  if (periods.size() < 2)
    throw RecordError({file.string(), 1, 1}, "a target spectrum needs two rows of period and pseudo-acceleration");
  TargetSpectrum out{file.filename().string(), damping, periods.front(), periods.back(), {}};
  out.acceleration = [periods, values](double t) {
    const auto after = std::upper_bound(periods.begin(), periods.end(), t);
    const std::size_t i =
        std::clamp<std::size_t>(static_cast<std::size_t>(after - periods.begin()), 1, periods.size() - 1);
    return values[i - 1] + (t - periods[i - 1]) / (periods[i] - periods[i - 1]) * (values[i] - values[i - 1]);
  };
  return out;
}

void check_range(const TargetSpectrum& target, double shortest, double longest) {
  if (!(shortest > 0 && longest > shortest))
    throw InputError(fmt::format("error: periods from {:g} to {:g} s are no range", shortest, longest));
  if (shortest < target.shortest || longest > target.longest)
    throw InputError(fmt::format("error: periods from {:g} to {:g} s, but {} is given from {:g} to {:g} s", shortest,
                                 longest, target.name, target.shortest, target.longest));
}

SpectralRatio spectral_ratio(std::span<const double> acceleration, double dt, const TargetSpectrum& target,
                             double shortest, double longest, int count) {
  check_range(target, shortest, longest);
  const std::vector<double> periods = logarithmic_periods(shortest, longest, count);
  const std::vector<double> psa =
      pseudo_acceleration(periods, spectral_displacement(acceleration, dt, periods, {target.damping, false}));
  SpectralRatio out{std::numeric_limits<double>::infinity(), 0, 0, 0, 0};
  for (std::size_t i = 0; i < periods.size(); ++i) {
    const double ratio = psa[i] / target.acceleration(periods[i]);
    if (ratio < out.least) out.least = ratio, out.least_at = periods[i];
    if (ratio > out.largest) out.largest = ratio, out.largest_at = periods[i];
    out.mean += std::log(ratio) / count;
  }
  out.mean = std::exp(out.mean);
  return out;
}

}  // namespace nsframe
