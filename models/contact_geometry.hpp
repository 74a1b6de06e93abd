// Which points of two structures face each other. A kind of contact geometry is one function that finds pairs, in a file of
// its own, and a line in the registry of build_contacts.cpp. Theory.md, "Contact geometry".
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "models/contacts.hpp"
#include "models/model.hpp"

namespace nsframe {

inline constexpr double level_tolerance = 1e-3;  // [m] points nearer than this count as one level, one face, one place

struct PairDraft {
  ContactPair pair;
  double level = 0;                    // of the slab [m]
  std::optional<double> distance;      // along the normal, by the coordinates [m]
  Location at;
};

// A straight edge of a slab, between two corners.
struct SlabEdge {
  const Slab* slab = nullptr;
  int first = -1, last = -1;           // corners, nodes
  Vector3 start, end;                  // [m]
  Vector3 outward;                     // horizontal unit normal
  double length() const { return (end - start).norm(); }
  Vector3 axis() const { return (end - start).normalized(); }
};

struct SlabCorner {
  const Slab* slab = nullptr;
  int node = -1;
  Vector3 position;
};

// What the functions that find pairs ask of a model, and their common errors.
class ContactScene {
 public:
  ContactScene(const ModelDescription& description, const Model& model, Diagnostics& diagnostics)
      : description_(description), model_(model), diagnostics_(diagnostics) {}

  const Model& model() const { return model_; }
  void error(const Location& at, std::string message) const { diagnostics_.error(at, std::move(message)); }
  const std::string& node_id(int node) const { return model_.nodes.id[static_cast<std::size_t>(node)]; }
  std::string short_id(int node) const;                 // without the structure
  const Vector3& position(int node) const { return model_.nodes.position[static_cast<std::size_t>(node)]; }

  // Index, or -1 after an error with the nearest name.
  int node(const Reference& reference) const;
  int structure(const Reference& reference) const;
  // Both sides as structures; nothing after an error.
  std::optional<std::pair<int, int>> structures(const ContactDescription& contact, std::string_view kind) const;

  std::vector<const Slab*> slabs_of(int description) const;  // from the lowest
  double level(const Slab& slab) const;
  // At one level, so that slab meets slab: they overlap over their thickness.
  bool meet(const Slab& a, const Slab& b) const;
  bool belongs(int node, int description) const;
  // Edges whose outward normals lie within 60 degrees of `direction`, and their corners by rising position across it.
  std::vector<SlabEdge> facing_edges(const Slab& slab, const Vector3& direction) const;
  std::vector<SlabCorner> facing_corners(const Slab& slab, const Vector3& direction) const;
  // The point of an edge at a distance from its start: between the nodes of the structure that lie on the edge.
  ContactPoint point_on(const SlabEdge& edge, double from_start) const;
  std::string edge_name(const SlabEdge& edge) const;
  std::string corner_name(const SlabCorner& corner) const;

 private:
  const ModelDescription& description_;
  const Model& model_;
  Diagnostics& diagnostics_;
};

// Horizontal unit vector across `direction` that points to rising y (or x).
Vector3 across(const Vector3& direction);
// Vertical sliding by which two slabs still meet.
SlidingRoom vertical_room(double level_a, double level_b, double half_thickness);

using PairFinder = std::vector<PairDraft> (*)(const ContactDescription&, const ContactScene&);
std::vector<PairDraft> find_nodes(const ContactDescription& contact, const ContactScene& scene);
std::vector<PairDraft> find_slab_corners(const ContactDescription& contact, const ContactScene& scene);
std::vector<PairDraft> find_slab_edges(const ContactDescription& contact, const ContactScene& scene);
std::vector<PairDraft> find_slab_columns(const ContactDescription& contact, const ContactScene& scene);
std::vector<PairDraft> find_facing(const ContactDescription& contact, const ContactScene& scene);
std::vector<PairDraft> find_wall(const ContactDescription& contact, const ContactScene& scene);

// Pairs of two slabs that meet (contact_slab_edges.cpp).
std::vector<PairDraft> edge_pairs(const Slab& a, const Slab& b, const ContactDescription& contact, const ContactScene& scene,
                                  double& nearest_left_out);
// When nothing was found: how far the nearest pair is beyond the reach, if there is any.
std::string beyond_reach(double nearest_left_out, const ContactDescription& contact);

}  // namespace nsframe
