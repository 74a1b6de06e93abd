#include "integrators/sustained_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nsframe {

namespace {

constexpr double panel_angle = 1.2;        // w h of a panel for the highest frequency that contact can feel
constexpr double longest_panel = 0.05;     // [s]
constexpr std::size_t most_sets = 256;

struct Gauss {
  std::array<double, panel_points> point{}, weight{};            // on [0, 1]
  Eigen::Matrix<long double, panel_points, 1> barycentric;       // of Lagrange's polynomials through the points
};

const Gauss& gauss() {
  static const Gauss rule = [] {
    Gauss g;
    constexpr int n = panel_points;
    std::array<long double, n> x{};
    for (int i = 0; i < n; ++i) {
      long double z = std::cos(static_cast<long double>(pi) * (n - i - 0.25L) / (n + 0.5L)), slope = 1;
      for (int iteration = 0; iteration < 50; ++iteration) {
        long double p = 1, q = 0;
        for (int k = 1; k <= n; ++k) {
          const long double next = ((2 * k - 1) * z * p - (k - 1) * q) / k;
          q = p;
          p = next;
        }
        slope = n * (z * p - q) / (z * z - 1);
        z -= p / slope;
      }
      const auto at = static_cast<std::size_t>(i);
      x[at] = (1 + z) / 2;
      g.point[at] = static_cast<double>(x[at]);
      g.weight[at] = static_cast<double>(1 / ((1 - z * z) * slope * slope));
    }
    for (std::size_t i = 0; i < n; ++i) {
      long double product = 1;
      for (std::size_t j = 0; j < n; ++j) {
        if (j != i) product *= static_cast<long double>(g.point[i]) - static_cast<long double>(g.point[j]);
      }
      g.barycentric[static_cast<Eigen::Index>(i)] = 1 / product;
    }
    return g;
  }();
  return rule;
}

using PanelVector = Eigen::Matrix<double, panel_points, 1>;

// Lagrange's polynomials at u.
PanelVector lagrange(double u) {
  const Gauss& g = gauss();
  PanelVector values;
  long double sum = 0;
  Eigen::Matrix<long double, panel_points, 1> terms;
  for (int i = 0; i < panel_points; ++i) {
    const long double distance = static_cast<long double>(u) - static_cast<long double>(g.point[static_cast<std::size_t>(i)]);
    if (distance == 0) {
      values.setZero();
      values[i] = 1;
      return values;
    }
    terms[i] = g.barycentric[i] / distance;
    sum += terms[i];
  }
  for (int i = 0; i < panel_points; ++i) values[i] = static_cast<double>(terms[i] / sum);
  return values;
}

}  // namespace

SustainedContact::SustainedContact(const ExactModes& modes, Propagator& propagator) : modes_(modes), propagator_(propagator), length_(longest_panel) {
  const int pairs = modes.pairs();
  if (pairs == 0) return;
  // a compliant pair adds a spring: frequencies up to the sum of both
  double fastest = modes.highest * modes.highest;
  for (int c = 0; c < pairs; ++c) {
    if (modes.compliant[static_cast<std::size_t>(c)]) fastest += modes.delassus(c, c) / modes.compliance(c, c);
  }
  if (fastest > 0) length_ = std::min(length_, panel_angle / std::sqrt(fastest));
  const Gauss& g = gauss();
  MatrixX G = modes.gap;  // of single modes; `coupled` adds what the others do
  for (const DampingCoupling& coupling : modes.couplings) G(Eigen::all, coupling.places).setZero();
  const CoupledMotion& coupled = propagator.coupled();
  for (const double u : g.point) nodes_.push_back(u * length_);
  VectorX response(modes.padded), second(modes.padded);
  for (const double u : g.point) {
    for (const double v : g.point) {
      const double s = u * length_ * (1 - v);
      const TaylorPowers powers(s);
      for (int k = 0; k < modes.padded; ++k) {
        const long double w2 = modes.square[k], a = modes.decay[k];
        const StepCoefficients c = step_coefficients(w2, a, powers);
        response[k] = static_cast<double>(c.B);
        second[k] = static_cast<double>(-2 * a * (c.A - 2 * a * c.B) - w2 * c.B);
      }
      displacement_.push_back(G * response.asDiagonal() * G.transpose());
      acceleration_.push_back(G * second.asDiagonal() * G.transpose());
      if (coupled.empty()) continue;
      displacement_.back() += coupled.displacement_response(s);
      acceleration_.back() += coupled.acceleration_response(s);
    }
  }
  VectorX before = VectorX::Zero(modes.padded), now = VectorX::Ones(modes.padded);
  for (std::size_t n = 0; n < moments_.size(); ++n) {
    moments_[n] = G * before.asDiagonal() * G.transpose();
    const VectorX next = -2 * modes.decay.cwiseProduct(now) - modes.square.cwiseProduct(before);
    before = now;
    now = next;
  }
  if (!coupled.empty()) {
    const std::array<MatrixX, 6> moments = coupled.moments();
    for (std::size_t n = 0; n < moments.size(); ++n) moments_[n] += moments[n];
    for (std::size_t n = 0; n < coupled_bound_.size(); ++n) coupled_bound_[n] = coupled.derivative_bound(static_cast<int>(n) + 1);
  }
  const MatrixX magnitude = G.cwiseAbs();
  size_ = magnitude * magnitude.transpose();
  const VectorX rate = (modes.square.cwiseSqrt() + 2 * modes.decay).cwiseAbs2();
  size2_ = magnitude * rate.asDiagonal() * magnitude.transpose();
  // Bernstein coefficients from values at the Gauss points
  MatrixX basis(panel_points, panel_points);
  for (int i = 0; i < panel_points; ++i) {
    const double u = g.point[static_cast<std::size_t>(i)];
    double choose = 1;
    for (int j = 0; j < panel_points; ++j) {
      basis(i, j) = choose * std::pow(u, j) * std::pow(1 - u, panel_points - 1 - j);
      choose = choose * (panel_points - 1 - j) / (j + 1);
    }
  }
  to_bernstein_ = basis.inverse();
}

const SustainedContact::SetSolver& SustainedContact::solver(const std::vector<int>& pairs) {
  const auto found = solvers_.find(pairs);
  if (found != solvers_.end()) return found->second;
  if (solvers_.size() >= most_sets) solvers_.clear();
  const auto count = static_cast<Eigen::Index>(pairs.size());
  const Gauss& g = gauss();
  SetSolver result;
  result.scale.resize(count);
  for (Eigen::Index c = 0; c < count; ++c) {
    const int pair = pairs[static_cast<std::size_t>(c)];
    const bool compliant = modes_.compliant[static_cast<std::size_t>(pair)];
    result.scale[c] = 1 / std::sqrt(compliant ? modes_.compliance(pair, pair) : modes_.delassus(pair, pair));
  }
  // row (node i, pair c), column (force at node j of pair d); in long double, as a heavy mass on a light one makes it nearly singular
  using Matrix = DenseMatrix<long double>;
  const Matrix G = modes_.gap(pairs, Eigen::all).cast<long double>(), delassus = G * G.transpose();
  Matrix matrix(panel_points * count, panel_points * count);
  for (int i = 0; i < panel_points; ++i) {
    for (Eigen::Index c = 0; c < count; ++c) {
      const int pair = pairs[static_cast<std::size_t>(c)];
      const bool compliant = modes_.compliant[static_cast<std::size_t>(pair)];
      for (Eigen::Index d = 0; d < count; ++d) {
        const int other = pairs[static_cast<std::size_t>(d)];
        PanelVector row = PanelVector::Zero();
        for (int q = 0; q < panel_points; ++q) {
          const auto at = static_cast<std::size_t>(i * panel_points + q);
          const double u = g.point[static_cast<std::size_t>(i)], response = (compliant ? displacement_ : acceleration_)[at](pair, other);
          row += (g.weight[static_cast<std::size_t>(q)] * u * length_ * response) * lagrange(u * g.point[static_cast<std::size_t>(q)]);
        }
        const long double scale = static_cast<long double>(result.scale[c]) * static_cast<long double>(result.scale[d]);
        for (int j = 0; j < panel_points; ++j) matrix(i * count + c, j * count + d) = scale * static_cast<long double>(row[j]);
        matrix(i * count + c, i * count + d) += scale * (compliant ? static_cast<long double>(modes_.compliance(pair, other)) : delassus(c, d));
      }
    }
  }
  result.factor.compute(matrix, 1e-13L);
  return solvers_.emplace(pairs, std::move(result)).first->second;
}

ContactForces SustainedContact::solve(const ModalState& state, const VectorX& gap_offset, const std::vector<int>& pairs) {
  ContactForces forces{pairs, {}, length_, force_noise(state, pairs)};
  const auto count = static_cast<Eigen::Index>(pairs.size());
  const SetSolver& set = solver(pairs);
  DenseVector<long double> rhs(panel_points * count);
  VectorX acceleration(modes_.padded);
  for (int i = 0; i < panel_points; ++i) {
    propagator_.step(state, nodes_[static_cast<std::size_t>(i)], at_node_);
    acceleration = propagator_.accelerations(at_node_);
    for (Eigen::Index c = 0; c < count; ++c) {
      const int pair = pairs[static_cast<std::size_t>(c)];
      const bool compliant = modes_.compliant[static_cast<std::size_t>(pair)];
      const double wrong = compliant ? modes_.gap.row(pair).dot(at_node_.x) + gap_offset[pair] : modes_.gap.row(pair).dot(acceleration);
      rhs[i * count + c] = -static_cast<long double>(set.scale[c] * wrong);
    }
  }
  const DenseVector<long double> solution = set.factor.solve(rhs);
  forces.values.resize(panel_points, count);
  for (int i = 0; i < panel_points; ++i) {
    for (Eigen::Index c = 0; c < count; ++c) forces.values(i, c) = set.scale[c] * static_cast<double>(solution[i * count + c]);
  }
  return forces;
}

VectorX SustainedContact::force_noise(const ModalState& state, const std::vector<int>& pairs) const {
  const auto count = static_cast<Eigen::Index>(pairs.size());
  // a load that passes through zero is rounded as it was before and will be after
  VectorX terms = state.f0.cwiseAbs() + longest_panel * state.f1.cwiseAbs() + 2 * modes_.decay.cwiseProduct(state.y.cwiseAbs()) + modes_.square.cwiseProduct(state.x.cwiseAbs());
  propagator_.coupled().add_sizes(state, terms);
  VectorX acceleration(count), scale(count);
  for (Eigen::Index c = 0; c < count; ++c) {
    const int pair = pairs[static_cast<std::size_t>(c)];
    const bool compliant = modes_.compliant[static_cast<std::size_t>(pair)];
    scale[c] = compliant ? 0 : 1 / std::sqrt(modes_.delassus(pair, pair));
    acceleration[c] = 16 * std::numeric_limits<double>::epsilon() * modes_.gap_size.row(pair).dot(terms);
  }
  const MatrixX inverse = RankRevealing<double>(scale.asDiagonal() * modes_.delassus(pairs, pairs) * scale.asDiagonal(), 1e-12).pseudo_inverse();
  return scale.cwiseProduct(inverse.cwiseAbs() * scale.cwiseProduct(acceleration));
}

void SustainedContact::move(const ModalState& from, const ContactForces& forces, double s, ModalState& after) const {
  // the convolution with the forces by Gauss's rule: impulses at its points
  const Gauss& g = gauss();
  ModalState now = from;
  CoupledMotion& coupled = propagator_.coupled();
  coupled.start_run();
  double at = 0;
  for (std::size_t i = 0; i < panel_points; ++i) {
    const double time = s * g.point[i];
    propagator_.move_oscillators(now, time - at, after);
    coupled.run(time - at);
    std::swap(now, after);
    at = time;
    const PanelVector basis = lagrange(time / forces.length);
    for (std::size_t k = 0; k < forces.pairs.size(); ++k) {
      const double force = basis.dot(forces.values.col(static_cast<Eigen::Index>(k)));
      now.y += (g.weight[i] * s * force) * modes_.gap.row(forces.pairs[k]).transpose();
      coupled.kick(forces.pairs[k], g.weight[i] * s * force);
    }
  }
  propagator_.move_oscillators(now, s - at, after);
  coupled.run(s - at);
  coupled.finish_run(after);
}

double SustainedContact::work(const VectorX& f1, const ContactForces& forces, double s) const {
  // - f1 int x dt: for oscillators (int f dt) / w^2 is missing, for the others the response's own integral
  if (forces.empty() || f1.isZero(0)) return 0;
  double work = 0;
  for (std::size_t k = 0; k < forces.pairs.size(); ++k) {
    const auto G = modes_.gap.row(forces.pairs[k]).transpose().array();
    double sum = (f1.array() * G * modes_.flexibility.array()).sum() * impulse(forces, k, s);
    for (const int m : modes_.special) {
      const double factor = f1[m] * modes_.gap(forces.pairs[k], m);
      for (std::size_t i = 0; i < panel_points; ++i) {
        const double at = s * gauss().point[i];
        const auto L = static_cast<double>(step_coefficients(modes_.square[m], modes_.decay[m], s - at).L);
        sum += factor * gauss().weight[i] * s * value(forces, k, at) * L;
      }
    }
    work -= sum;
  }
  CoupledMotion& coupled = propagator_.coupled();
  if (coupled.empty()) return work;
  coupled.weigh(f1);
  VectorX impulses = VectorX::Zero(modes_.pairs());
  for (std::size_t i = 0; i < panel_points; ++i) {
    const double at = s * gauss().point[i];
    for (std::size_t k = 0; k < forces.pairs.size(); ++k) impulses[forces.pairs[k]] = gauss().weight[i] * s * value(forces, k, at);
    work -= coupled.impulse_integral(s - at, impulses);
  }
  return work;
}

double SustainedContact::value(const ContactForces& forces, std::size_t k, double s) {
  return lagrange(s / forces.length).dot(forces.values.col(static_cast<Eigen::Index>(k)));
}

double SustainedContact::slope(const ContactForces& forces, std::size_t k, double s) const {
  VectorX b = bernstein(forces, k);
  constexpr Eigen::Index degree = panel_points - 1;
  b = ((b.tail(degree) - b.head(degree)) * (degree / forces.length)).eval();
  const double u = s / forces.length;
  for (Eigen::Index left = degree - 1; left > 0; --left) b.head(left) = ((1 - u) * b.head(left) + u * b.segment(1, left)).eval();
  return b[0];
}

double SustainedContact::impulse(const ContactForces& forces, std::size_t k, double s) {
  const Gauss& g = gauss();
  double sum = 0;
  for (std::size_t i = 0; i < panel_points; ++i) sum += g.weight[i] * s * value(forces, k, s * g.point[i]);
  return sum;
}

VectorX SustainedContact::bernstein(const ContactForces& forces, std::size_t k) const {
  return to_bernstein_ * forces.values.col(static_cast<Eigen::Index>(k));
}

namespace {

// Derivatives of a polynomial in Bernstein form: at the start, and bounds over the interval.
struct PolynomialDerivatives {
  std::array<double, 7> start{}, bound{};
};

PolynomialDerivatives derivatives_of(VectorX b, double length) {
  PolynomialDerivatives d;
  for (std::size_t n = 0; n < 7; ++n) {
    d.start[n] = b[0];
    d.bound[n] = b.cwiseAbs().maxCoeff();
    const auto degree = b.size() - 1;
    b = ((b.tail(degree) - b.head(degree)) * (static_cast<double>(degree) / length)).eval();
  }
  return d;
}

}  // namespace

void SustainedContact::add_derivatives(const ContactForces& forces, int pair, Eigen::Matrix<double, 7, 1>& gap) const {
  for (std::size_t k = 0; k < forces.pairs.size(); ++k) {
    const int other = forces.pairs[k];
    const auto d = derivatives_of(bernstein(forces, k), forces.length);
    for (std::size_t n = 0; n < 7; ++n) {
      double sum = modes_.compliance(pair, other) * d.start[n];
      for (std::size_t j = 0; j < n && n - 1 - j < moments_.size(); ++j) sum += moments_[n - 1 - j](pair, other) * d.start[j];
      gap[static_cast<Eigen::Index>(n)] += sum;
    }
  }
}

double SustainedContact::fourth_bound(const ContactForces& forces, int pair) const {
  double bound = 0;
  for (std::size_t k = 0; k < forces.pairs.size(); ++k) {
    const int other = forces.pairs[k];
    const auto d = derivatives_of(bernstein(forces, k), forces.length).bound;
    // x = int B(s - t) f dt: x'''' = f'' + B''(0) f' + B'''(0) f + int B'''' f dt, |B^(n)| <= (w + 2 a)^(n - 1)
    bound += size2_(pair, other) * d[0] * (1 + modes_.highest * forces.length) + std::sqrt(size2_(pair, other) * size_(pair, other)) * d[1] +
             size_(pair, other) * d[2] + std::abs(modes_.compliance(pair, other)) * d[4];
    if (propagator_.coupled().empty()) continue;
    bound += coupled_bound_[0](pair, other) * d[2] + coupled_bound_[1](pair, other) * d[1] +
             (coupled_bound_[2](pair, other) + coupled_bound_[3](pair, other) * forces.length) * d[0];
  }
  return bound;
}

}  // namespace nsframe
