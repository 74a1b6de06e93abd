// Special members of what is large: made here once, not in every source that holds a scene.
#include "scene/scene.hpp"

#include "scene/tables.hpp"

namespace nsframe {

SceneTables::SceneTables() = default;
SceneTables::SceneTables(const SceneTables&) = default;
SceneTables::SceneTables(SceneTables&&) noexcept = default;
SceneTables& SceneTables::operator=(const SceneTables&) = default;
SceneTables& SceneTables::operator=(SceneTables&&) noexcept = default;
SceneTables::~SceneTables() = default;

Scene::Scene() = default;
Scene::Scene(const Scene&) = default;
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(const Scene&) = default;
Scene& Scene::operator=(Scene&&) noexcept = default;
Scene::~Scene() = default;

}  // namespace nsframe
