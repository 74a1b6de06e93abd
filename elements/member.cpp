#include "elements/member.hpp"

#include <vector>

#include "elements/member_mass.hpp"

namespace nsframe {

namespace {

constexpr double part_change = 1e-4;  // of a member's load, for derivatives by it

}  // namespace

void Members::add(const ElementNodes& nodes, std::string id, const BeamFrame& frame, int history_size, bool loaded) {
  ElementGroup::add(nodes, std::move(id));
  frames_.push_back(frame);
  Place& place = places_.back();
  place.own = own_offset(loaded);
  place.loaded = loaded;
  place.factor = loaded && !linear();
  const int end = place.begin + place.own + history_size;
  places_.push_back({end});
}

void Members::initialize_history(int element, double* history) const {
  geometry_.initialize_history(history);
  if (double* const factor = load_factor(element, history)) *factor = 0;
  initialize_basic(element, history + own_begin(element));
}

void Members::start_step(int element, const double* committed, double* trial) const {
  const int own = own_begin(element);
  if (double* const factor = load_factor(element, trial)) *factor = committed[own - 1];
  start_basic(element, committed + own, trial + own);
}

void Members::respond(int element, const Vector12& displacement, const double* committed, double* trial, Vector12& force,
                      Matrix12* tangent) const {
  respond_by([&](auto&&... arguments) { respond_basic(element, arguments...); }, element, displacement, committed, trial, force, tangent);
}

void Members::respond_once(int element, const Vector12& displacement, const double* committed, double* trial, Vector12& force,
                           Matrix12* tangent) const {
  respond_by([&](auto&&... arguments) { pass_basic(element, arguments...); }, element, displacement, committed, trial, force, tangent);
}

template <class Basic>
void Members::respond_by(const Basic& basic, int element, const Vector12& displacement, const double* committed, double* trial,
                         Vector12& force, Matrix12* tangent) const {
  const BeamFrame& frame = this->frame(element);
  const int own = own_begin(element);
  Acting acting;
  find_acting(element, load_part(element, trial), displacement, committed, acting);
  Vector6 basic_force;
  Matrix6 basic_tangent;
  const Vector6 deformation = geometry_.deformation(frame, displacement, committed, trial);
  basic(deformation, acting, geometry_.rounding(displacement), committed + own, trial + own, basic_force, tangent ? &basic_tangent : nullptr);
  geometry_.to_global(frame, displacement, committed, basic_force, basic_tangent, force, tangent);
  if (!loaded(element)) return;
  geometry_.add_load(frame, *load(element), acting.part, displacement, committed, force, tangent);
  if (!acting.dead) return;
  const DeadResponse response = dead_response(element, deformation, basic_force, acting.part, acting.axes, committed + own, trial + own);
  geometry_.add_dead_load(frame, *load(element), acting.part, dead_moment(response, acting.part, acting.axes), displacement, committed,
                          force, tangent);
}

void Members::find_acting(int element, double part, const Vector12& displacement, const double* committed, Acting& acting) const {
  if (!loaded(element)) return;
  acting.part = part;
  acting.load = load(element);
  acting.dead = acting.load->dead();
  if (!acting.dead) return;
  acting.axes = geometry_.axes(frame(element), displacement, committed);
  acting.turned = acting.load->in(acting.axes);
  acting.load = &acting.turned;
}

Matrix12 Members::geometric_change(int element, const Vector12& displacement, const Vector12& step, double load_step,
                                   const double* committed, double* trial) const {
  const BeamFrame& frame = this->frame(element);
  const int own = own_begin(element);
  Acting acting;
  find_acting(element, load_part(element, trial), displacement, committed, acting);
  const Vector6 deformation = geometry_.deformation(frame, displacement, committed, trial);
  const double rounding = geometry_.rounding(displacement);
  Vector6 basic_force;
  Matrix6 basic_tangent;
  const auto answer = [&](Vector6& force, DeadResponse& response) {
    respond_basic(element, deformation, acting, rounding, committed + own, trial + own, force, &basic_tangent);
    if (acting.dead) response = dead_response(element, deformation, force, acting.part, acting.axes, committed + own, trial + own);
  };
  Vector6 force_by_part = Vector6::Zero();
  Vector9 displacement_by_part = Vector9::Zero();
  DeadResponse response;
  if (loaded(element) && load_step != 0) {
    const double part = acting.part;
    Vector6 more, less;
    DeadResponse with_more, with_less;
    acting.part = part + part_change;
    answer(more, with_more);
    acting.part = part - part_change;
    answer(less, with_less);
    acting.part = part;
    force_by_part = (more - less) / (2 * part_change);
    displacement_by_part = (with_more.displacement - with_less.displacement) / (2 * part_change);
  }
  answer(basic_force, response);
  const auto tangent_at = [&](double side) {
    const Vector12 u = displacement + side * step;
    const double part = acting.part + side * load_step;
    const Vector6 change = geometry_.deformation(frame, u, committed, trial) - deformation;
    Vector6 force_there = basic_force + basic_tangent * change + side * load_step * force_by_part;
    Vector12 force;
    Matrix12 tangent;
    DeadMoment moment;
    if (acting.dead) {
      const Matrix3 axes = geometry_.axes(frame, u, committed);
      const Vector9 turned = acting.part * entries(axes - acting.axes);
      force_there += response.force * turned;
      DeadResponse there = response;
      there.displacement += response.displacement_by_load * turned - response.force.transpose() * change +
                            side * load_step * displacement_by_part;
      moment = dead_moment(there, part, axes);
    }
    geometry_.to_global(frame, u, committed, force_there, basic_tangent, force, &tangent);
    if (loaded(element)) geometry_.add_load(frame, *load(element), part, u, committed, force, &tangent);
    if (acting.dead) geometry_.add_dead_load(frame, *load(element), part, moment, u, committed, force, &tangent);
    return tangent;
  };
  return 0.5 * (tangent_at(1) - tangent_at(-1));
}

ElementShape Members::member_shape(int element, const SectionOutline* outline, const Releases& releases) const {
  const BeamFrame& frame = this->frame(element);
  Matrix6 prismatic = Matrix6::Identity();  // what the shape functions bend like
  prismatic.block<2, 2>(1, 1) << 4, 2, 2, 4;
  prismatic.block<2, 2>(3, 3) << 4, 2, 2, 4;
  return {outline != nullptr, geometry_.finite(), frame.axes, frame.length, frame.offset, outline, member_ends(releases, prismatic, frame)};
}

ElementPose Members::pose(int element, const Vector12& displacement, const double* history) const {
  return geometry_.pose(frame(element), displacement, history);
}

std::vector<SectionResult> Members::sections(int element, const Vector12& displacement, const double* history) const {
  std::vector<double> scratch(static_cast<std::size_t>(geometry_.history_size()));
  const Vector6 deformation = geometry_.deformation(frame(element), displacement, history, scratch.data());
  Acting acting;
  find_acting(element, load_part(element, history), displacement, history, acting);
  return basic_sections(element, deformation, acting, history + own_begin(element));
}

}  // namespace nsframe
