// The schema of a whole scene; see schema.hpp.
#pragma once

#include "scene/scene.hpp"
#include "scene/schema.hpp"
#include "scene/schema_calibration.hpp"
#include "scene/schema_contact.hpp"
#include "scene/schema_structure.hpp"

namespace nsframe {

// A list of these is a table of tables keyed by their names: [material.NAME].
template <class Table>
constexpr bool is_named(const Table*) {
  return false;
}
constexpr bool is_named(const MaterialTable*) { return true; }
constexpr bool is_named(const SectionTable*) { return true; }
constexpr bool is_named(const StructureTable*) { return true; }

template <class Archive>
void visit(Archive& ar, Scene& s) {
  ar(Field{"title", "one line"}, s.title);
  ar(Field{"material", "uniaxial laws: `[material.NAME]`"}, s.tables.materials);
  ar(Field{"section", "cross-sections: `[section.NAME]`"}, s.tables.sections);
  ar(Field{"structure", "structures: `[structure.NAME]`"}, s.tables.structures);
  ar(Field{"contact", "contacts: `[[contact]]`"}, s.tables.contacts);
  ar(Field{"gravity", "gravity; without this table there is none"}, s.tables.gravity);
  ar(Field{"static", "static stages before the motion, or without one: `[[static]]`, in their order"}, s.tables.stages);
  ar(Field{"motion", "base motion: `[motion]`, or `[[motion]]` for several"}, s.tables.motions);
  ar(Field{"analysis", "time history"}, s.analysis);
  ar(Field{"output", "what is kept"}, s.output);
  ar(Field{"calibration", "what `nsframe calibrate` fits, and to what"}, s.tables.calibration);
}

}  // namespace nsframe
