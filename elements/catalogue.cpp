#include "elements/catalogue.hpp"

#include <algorithm>
#include <cctype>

#include "elements/fiber_cutting.hpp"

namespace nsframe {

namespace {

// Every table of shapes.
template <class Visit>
void for_each_shape(Visit&& visit) {
  for (const auto& table : {european_shapes(), w_shapes()})
    for (const CatalogueShape& shape : table) visit(shape);
}

}  // namespace

std::string catalogue_name(std::string_view text) {
  std::string name;
  for (const char c : text) {
    const auto u = static_cast<unsigned char>(c);
    if (!std::isspace(u)) name += static_cast<char>(std::toupper(u));
  }
  const bool en_order = name.size() > 3 && name.starts_with("HE") &&
                        std::isdigit(static_cast<unsigned char>(name[2])) && std::string_view("ABM").find(name.back()) != std::string_view::npos;
  return en_order ? "HE" + name.substr(name.size() - 1) + name.substr(2, name.size() - 3) : name;
}

const CatalogueShape* find_shape(std::string_view name) {
  const CatalogueShape* found = nullptr;
  for_each_shape([&found, key = catalogue_name(name)](const CatalogueShape& shape) {
    if (shape.name == key) found = &shape;
  });
  return found;
}

std::vector<std::string> shape_names() {
  std::vector<std::string> names;
  for_each_shape([&names](const CatalogueShape& shape) { names.emplace_back(shape.name); });
  return names;
}

AreaMoments shape_moments(const CatalogueShape& shape, bool fillets) {
  const double root = shape.h / 2 - shape.tf, web = shape.tw / 2;
  AreaMoments sum = moments(Rectangle{{-root, root}, {-web, web}});
  for (const double side : {1.0, -1.0}) {
    sum.add(moments(Rectangle{{side * root, side * shape.h / 2}, {-shape.b / 2, shape.b / 2}}));
    for (const double edge : {1.0, -1.0})
      if (fillets && shape.r > 0) sum.add(spandrel(shape.r, {side * root, edge * web}, {-side, edge}));
  }
  // symmetry, but for rounding
  sum.centroid.setZero();
  sum.second(0, 1) = sum.second(1, 0) = 0;
  return sum;
}

// Order: flange at +y, then at -y, each by layers away from the web, each layer by rising z; web by rising y; fillets.
std::vector<FiberDescription> shape_fibers(const CatalogueShape& shape, const ShapeMesh& mesh,
                                           const Reference& material) {
  const auto& [name, h, b, tw, tf, r, A, I_strong, I_weak, J] = shape;
  const Spacing spacing = mesh.exact_moments ? Spacing::exact : Spacing::midpoints;
  std::vector<FiberDescription> fibers;
  for (const double side : {1.0, -1.0})
    add_rectangle(fibers, {{side * (h / 2 - tf), side * h / 2}, {-b / 2, b / 2}}, mesh.flange_layers,
                  mesh.flange_width, material, spacing);
  const double root = h / 2 - tf;
  add_rectangle(fibers, {{-root, root}, {-tw / 2, tw / 2}}, mesh.web, 1, material, spacing);
  if (mesh.fillets) {
    for (const double side : {1.0, -1.0}) {
      for (const double edge : {1.0, -1.0}) {
        const AreaMoments fillet = spandrel(r, {side * root, edge * tw / 2}, {-side, edge});
        fibers.push_back({fillet.centroid.x(), fillet.centroid.y(), fillet.area, material});
      }
    }
  }
  if (mesh.exact_moments) match_moments(fibers, shape_moments(shape, mesh.fillets));
  return fibers;
}

SectionOutline shape_outline(const CatalogueShape& shape) {
  const double depth = shape.h / 2, root = shape.h / 2 - shape.tf, width = shape.b / 2, web = shape.tw / 2;
  return {{depth, -width}, {depth, width},   {root, width},   {root, web},   {-root, web}, {-root, width},
          {-depth, width}, {-depth, -width}, {-root, -width}, {-root, -web}, {root, -web}, {root, -width}};
}

}  // namespace nsframe
