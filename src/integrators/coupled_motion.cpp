#include "integrators/coupled_motion.hpp"

#include <algorithm>
#include <cmath>

namespace nsframe {

namespace {

constexpr std::size_t most_kept = 32;
constexpr int series_terms = 24;      // of exp(B s) with |B| s <= 1

// c after s in a dense block, c' = B c + b0 + b1 t, and the integral of c, by Taylor series over parts with |B| s <= 1.
void move_dense(const DiagonalBlock& block, double s, VectorX c, VectorX b0, const VectorX& b1, Eigen::Ref<VectorX> after, VectorX* integral) {
  const double parts = std::max(1.0, std::ceil(block.magnitude * s)), h = s / parts;
  VectorX sum = VectorX::Zero(block.size);
  for (double part = 0; part < parts; ++part) {
    VectorX term = c;                 // derivative n times h^n / n!
    sum += h * c;
    for (int n = 1; n <= series_terms; ++n) {
      VectorX next = block.matrix * term;
      if (n == 1) next += b0;
      if (n == 2) next += h * b1;
      term = (h / n) * next;
      c += term;
      sum += (h / (n + 1)) * term;
    }
    b0 += h * b1;
  }
  after = c;
  if (integral) *integral = sum;
}

}  // namespace

CoupledMotion::CoupledMotion(const ExactModes& modes) : modes_(modes) {
  for (const DampingCoupling& coupling : modes.couplings) {
    Set set;
    set.coupling = &coupling;
    set.modes = static_cast<int>(coupling.square.size());
    set.follow = static_cast<int>(coupling.rate.size());
    set.size = 2 * set.modes + set.follow;
    const MatrixX &V = coupling.form.basis, &W = coupling.form.inverse;  // rows and columns: x, z, y
    set.basis = PaddedMatrix(V);
    set.inverse = PaddedMatrix(W);
    set.load = PaddedMatrix(W.rightCols(set.modes));
    set.displacement = V.topRows(set.modes);
    const MatrixX G = modes.gap(Eigen::all, coupling.modal_places());
    set.gap = G * set.displacement;
    set.kick = W.rightCols(set.modes) * G.transpose();
    const auto& blocks = coupling.form.blocks;
    set.gap_size.resize(G.rows(), static_cast<Eigen::Index>(blocks.size()));
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      set.gap_size.col(static_cast<Eigen::Index>(b)) = set.gap.middleCols(blocks[b].first, blocks[b].size).rowwise().norm();
    }
    set.c = set.b0 = set.b1 = set.result = VectorX::Zero(set.basis.padded_rows());
    set.weight = VectorX::Zero(set.size);
    sets_.push_back(std::move(set));
  }
}

void CoupledMotion::begin(const ModalState& from) {
  for (Set& set : sets_) {
    const auto& places = set.coupling->places;
    set.room.resize(set.size);
    set.room2.resize(set.modes);
    for (int i = 0; i < set.modes + set.follow; ++i) set.room[i] = from.x[places[static_cast<std::size_t>(i)]];
    for (int i = 0; i < set.modes; ++i) set.room[set.modes + set.follow + i] = from.y[places[static_cast<std::size_t>(i)]];
    set.inverse.multiply(set.room.data(), set.c.data());
    for (int i = 0; i < set.modes; ++i) {
      set.room[i] = from.f0[places[static_cast<std::size_t>(i)]];
      set.room2[i] = from.f1[places[static_cast<std::size_t>(i)]];
    }
    set.load.multiply(nullptr, set.room.data(), set.room2.data(), set.b0.data(), set.b1.data());
  }
}

CoupledMotion::Factors CoupledMotion::factors(const DiagonalBlock& block, double s, bool long_double) {
  // of pairs, c = c_1 - i c_2 has c' = (real + i imag) c
  const long double a = block.real * static_cast<long double>(s), w = block.imag * static_cast<long double>(s);
  const Complex z(static_cast<double>(a), static_cast<double>(w));
  Complex e;
  if (long_double) {
    const long double fade = std::exp(a);
    e = {static_cast<double>(fade * std::cos(w)), static_cast<double>(fade * std::sin(w))};
  } else {
    const double fade = std::exp(z.real());
    e = {fade * std::cos(z.imag()), fade * std::sin(z.imag())};
  }
  Complex p1, p2, p3;  // (e^z - 1) / z and the like, without powers of s
  if (std::norm(z) < 1) {
    p3 = 1.0 / 6;
    Complex term = p3;
    for (int n = 4; n <= series_terms; ++n) {
      term *= z / static_cast<double>(n);
      p3 += term;
    }
    p2 = 0.5 + z * p3;
    p1 = 1.0 + z * p2;
  } else {
    p1 = (e - 1.0) / z;
    p2 = (p1 - 1.0) / z;
    p3 = (p2 - 0.5) / z;
  }
  return {e, s * p1, s * s * p2, s * s * s * p3};
}

const std::vector<CoupledMotion::Factors>& CoupledMotion::find(Set& set, double s, bool kept) {
  std::vector<Factors>* factors_of_s = &passing_;
  if (kept) {
    for (const KeptFactors& one : set.kept) {
      if (one.s == s) return one.blocks;
    }
    if (set.kept.size() >= most_kept) set.kept.clear();
    set.kept.push_back({s, {}});
    factors_of_s = &set.kept.back().blocks;
  }
  factors_of_s->clear();
  for (const DiagonalBlock& block : set.coupling->form.blocks) {
    factors_of_s->push_back(block.dense() ? Factors{} : factors(block, s, kept));
  }
  return *factors_of_s;
}

void CoupledMotion::move(const Set& set, const std::vector<Factors>& factors, double s, const VectorX& c, const VectorX& b0, const VectorX& b1,
                         VectorX& after, VectorX* integral) {
  after.resize(set.size);
  if (integral) integral->resize(set.size);
  const auto& blocks = set.coupling->form.blocks;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const DiagonalBlock& block = blocks[b];
    const Eigen::Index k = block.first;
    const Factors& f = factors[b];
    if (block.dense()) {
      VectorX part;
      move_dense(block, s, c.segment(k, block.size), b0.segment(k, block.size), b1.segment(k, block.size), after.segment(k, block.size),
                 integral ? &part : nullptr);
      if (integral) integral->segment(k, block.size) = part;
    } else if (block.size == 1) {
      after[k] = f.e.real() * c[k] + f.p1.real() * b0[k] + f.p2.real() * b1[k];
      if (integral) (*integral)[k] = f.p1.real() * c[k] + f.p2.real() * b0[k] + f.p3.real() * b1[k];
    } else {
      const auto sum = [&](Complex p, Complex q, Complex r) {
        return Complex(p.real() * c[k] + p.imag() * c[k + 1] + q.real() * b0[k] + q.imag() * b0[k + 1] + r.real() * b1[k] + r.imag() * b1[k + 1],
                       p.real() * c[k + 1] - p.imag() * c[k] + q.real() * b0[k + 1] - q.imag() * b0[k] + r.real() * b1[k + 1] - r.imag() * b1[k]);
      };
      const Complex moved = sum(f.e, f.p1, f.p2);
      after[k] = moved.real();
      after[k + 1] = moved.imag();
      if (!integral) continue;
      const Complex summed = sum(f.p1, f.p2, f.p3);
      (*integral)[k] = summed.real();
      (*integral)[k + 1] = summed.imag();
    }
  }
}

void CoupledMotion::write(const Set& set, const VectorX& c, ModalState& after) const {
  const auto& places = set.coupling->places;
  set.basis.multiply(c.data(), set.result.data());
  for (int i = 0; i < set.modes + set.follow; ++i) {
    const int k = places[static_cast<std::size_t>(i)];
    after.x[k] = set.result[i];
    after.y[k] = i < set.modes ? set.result[set.modes + set.follow + i] : 0;
  }
}

void CoupledMotion::at(double s, ModalState& after, bool kept) {
  for (Set& set : sets_) {
    move(set, find(set, s, kept), s, set.c, set.b0, set.b1, moved_, nullptr);
    write(set, moved_, after);
  }
}

void CoupledMotion::integrate(double s, VectorX& integral) {
  for (Set& set : sets_) {
    move(set, find(set, s, false), s, set.c, set.b0, set.b1, moved_, &sum_);
    const VectorX x = set.displacement * sum_;
    for (int i = 0; i < set.modes; ++i) integral[set.coupling->places[static_cast<std::size_t>(i)]] = x[i];
  }
}

void CoupledMotion::start_run() {
  for (Set& set : sets_) {
    set.run_c = set.c;
    set.run_b0 = set.b0;
  }
}

void CoupledMotion::run(double s) {
  for (Set& set : sets_) {
    move(set, find(set, s, false), s, set.run_c, set.run_b0, set.b1, moved_, nullptr);
    set.run_c = moved_;
    set.run_b0 += s * set.b1;
  }
}

void CoupledMotion::kick(int pair, double impulse) {
  for (Set& set : sets_) set.run_c += impulse * set.kick.col(pair);
}

void CoupledMotion::finish_run(ModalState& after) {
  for (const Set& set : sets_) write(set, set.run_c, after);
}

namespace {

VectorX gather(const VectorX& all, const std::vector<int>& places, int first, int count) {
  VectorX part(count);
  for (int i = 0; i < count; ++i) part[i] = all[places[static_cast<std::size_t>(first + i)]];
  return part;
}

}  // namespace

void CoupledMotion::accelerations(const ModalState& state, VectorX& out) const {
  for (const Set& set : sets_) {
    const DampingCoupling& k = *set.coupling;
    const VectorX coupled = k.coupling * gather(state.x, k.places, set.modes, set.follow) - k.damping * gather(state.y, k.places, 0, set.modes);
    for (int i = 0; i < set.modes; ++i) out[k.places[static_cast<std::size_t>(i)]] += coupled[i];
  }
}

void CoupledMotion::add_sizes(const ModalState& state, VectorX& out) const {
  for (const Set& set : sets_) {
    const DampingCoupling& k = *set.coupling;
    const VectorX coupled = k.coupling.cwiseAbs() * gather(state.x, k.places, set.modes, set.follow).cwiseAbs() +
                            k.damping.cwiseAbs() * gather(state.y, k.places, 0, set.modes).cwiseAbs();
    for (int i = 0; i < set.modes; ++i) out[k.places[static_cast<std::size_t>(i)]] += coupled[i];
  }
}

void CoupledMotion::derivatives(const ModalState& state, Eigen::Matrix<double, Eigen::Dynamic, 7>& out) const {
  for (const Set& set : sets_) {
    const DampingCoupling& k = *set.coupling;
    VectorX z = gather(state.x, k.places, set.modes, set.follow), before = gather(state.x, k.places, 0, set.modes),
            now = gather(state.y, k.places, 0, set.modes);
    for (int n = 2; n < 7; ++n) {
      VectorX next = k.coupling * z - k.damping * now - k.square.cwiseProduct(before);
      if (n == 2) next += gather(state.f0, k.places, 0, set.modes);
      if (n == 3) next += gather(state.f1, k.places, 0, set.modes);
      z = (-(k.coupling.transpose() * now) - k.rate.cwiseProduct(z)).eval();
      for (int i = 0; i < set.modes; ++i) out(k.places[static_cast<std::size_t>(i)], n) = next[i];
      before = now;
      now = next;
    }
  }
}

void CoupledMotion::add_fourth(VectorX& fourth) const {
  for (const Set& set : sets_) {
    const auto& blocks = set.coupling->form.blocks;
    VectorX most(static_cast<Eigen::Index>(blocks.size()));
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      const DiagonalBlock& block = blocks[b];
      const Eigen::Index k = block.first, size = block.size;
      const MatrixX B = block.full();
      const VectorX second = B * (B * set.c.segment(k, size) + set.b0.segment(k, size)) + set.b1.segment(k, size);
      most[static_cast<Eigen::Index>(b)] = block.growth * block.magnitude * block.magnitude * second.norm();
    }
    fourth += set.gap_size * most;
  }
}

void CoupledMotion::set_rates(ModalState& state) const {
  for (const Set& set : sets_) {
    const DampingCoupling& k = *set.coupling;
    const VectorX z = gather(state.x, k.places, set.modes, set.follow),
                  rate = -(k.coupling.transpose() * gather(state.y, k.places, 0, set.modes)) - k.rate.cwiseProduct(z);
    for (int i = 0; i < set.follow; ++i) state.y[k.places[static_cast<std::size_t>(set.modes + i)]] = rate[i];
  }
}

void CoupledMotion::clear_rates(ModalState& state) const {
  for (const Set& set : sets_) {
    for (int i = 0; i < set.follow; ++i) state.y[set.coupling->places[static_cast<std::size_t>(set.modes + i)]] = 0;
  }
}

double CoupledMotion::rest_work(const VectorX& from, const VectorX& to) const {
  double work = 0;
  for (const Set& set : sets_) {
    for (int i = 0; i < set.follow; ++i) {
      const int k = set.coupling->places[static_cast<std::size_t>(set.modes + i)];
      work += set.coupling->rest[i] * (to[k] - from[k]);
    }
  }
  return work;
}

namespace {

// B^n exp(B s) of a block.
MatrixX exponential_of(const DiagonalBlock& block, double s, int power) {
  const MatrixX B = block.full();
  MatrixX result = MatrixX::Identity(block.size, block.size);
  if (block.dense()) {
    const double parts = std::max(1.0, std::ceil(block.magnitude * s));
    MatrixX once = result, term = result;
    for (int n = 1; n <= series_terms; ++n) {
      term = (B * term * (s / parts / n)).eval();
      once += term;
    }
    for (double part = 0; part < parts; ++part) result = (once * result).eval();
  } else {
    const auto fade = static_cast<double>(std::exp(block.real * static_cast<long double>(s)));
    if (block.size == 1) {
      result *= fade;
    } else {
      const long double angle = block.imag * static_cast<long double>(s);
      const auto c = static_cast<double>(std::cos(angle)), d = static_cast<double>(std::sin(angle));
      result = fade * Eigen::Matrix2d{{c, d}, {-d, c}};
    }
  }
  for (int n = 0; n < power; ++n) result = (B * result).eval();
  return result;
}

}  // namespace

MatrixX CoupledMotion::response(double s, int derivative) const {
  MatrixX sum = MatrixX::Zero(modes_.pairs(), modes_.pairs());
  for (const Set& set : sets_) {
    for (const DiagonalBlock& block : set.coupling->form.blocks) {
      sum += set.gap.middleCols(block.first, block.size) * exponential_of(block, s, derivative) * set.kick.middleRows(block.first, block.size);
    }
  }
  return sum;
}

std::array<MatrixX, 6> CoupledMotion::moments() const {
  std::array<MatrixX, 6> moments;
  for (MatrixX& moment : moments) moment = MatrixX::Zero(modes_.pairs(), modes_.pairs());
  for (const Set& set : sets_) {
    const DampingCoupling& k = *set.coupling;
    const MatrixX G = modes_.gap(Eigen::all, k.modal_places());
    MatrixX before = MatrixX::Zero(set.modes, G.rows()), now = G.transpose(), z = MatrixX::Zero(set.follow, G.rows());
    for (std::size_t n = 1; n < moments.size(); ++n) {
      moments[n] += G * now;
      const MatrixX next = k.coupling * z - k.damping * now - k.square.asDiagonal() * before;
      z = (-(k.coupling.transpose() * now) - k.rate.asDiagonal() * z).eval();
      before = now;
      now = next;
    }
  }
  return moments;
}

MatrixX CoupledMotion::derivative_bound(int n) const {
  MatrixX sum = MatrixX::Zero(modes_.pairs(), modes_.pairs());
  for (const Set& set : sets_) {
    const auto& blocks = set.coupling->form.blocks;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      const DiagonalBlock& block = blocks[b];
      const VectorX kicks = set.kick.middleRows(block.first, block.size).colwise().norm();
      sum += (block.growth * std::pow(block.magnitude, n)) * set.gap_size.col(static_cast<Eigen::Index>(b)) * kicks.transpose();
    }
  }
  return sum;
}

void CoupledMotion::weigh(const VectorX& load) {
  for (Set& set : sets_) set.weight = set.displacement.transpose() * gather(load, set.coupling->places, 0, set.modes);
}

double CoupledMotion::impulse_integral(double s, const VectorX& impulses) const {
  double sum = 0;
  for (const Set& set : sets_) {
    const VectorX c = set.kick * impulses, none = VectorX::Zero(set.size);
    std::vector<Factors> now;
    for (const DiagonalBlock& block : set.coupling->form.blocks) now.push_back(block.dense() ? Factors{} : factors(block, s, false));
    VectorX after, integral;
    move(set, now, s, c, none, none, after, &integral);
    sum += set.weight.dot(integral);
  }
  return sum;
}

}  // namespace nsframe
