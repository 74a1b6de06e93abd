// Rules of a table that span several keys; called when its single keys are without error.
#pragma once

#include "models/analysis.hpp"
#include "scene/calibration_table.hpp"
#include "scene/tables.hpp"

namespace nsframe {

class TableReader;

template <class Table>
void check(TableReader&, const Table&) {}

void check(TableReader& table, const MassTable& mass);
void check(TableReader& table, const BeamTable& beam);
void check(TableReader& table, const Integration& integration);
void check(TableReader& table, const MemberMass& mass);
void check(TableReader& table, const EndReleases& releases);
void check(TableReader& table, const WallTable& wall);
void check(TableReader& table, const LoadTable& load);
void check(TableReader& table, const BarTable& bar);
void check(TableReader& table, const InfillTable& infill);
void check(TableReader& table, const SpringTable& spring);
void check(TableReader& table, const LinkTable& link);
void check(TableReader& table, const SlabTable& slab);
void check(TableReader& table, const DampingTable& damping);
void check(TableReader& table, const ExplicitStructure& structure);
void check(TableReader& table, const StoryFrameTable& frame);
void check(TableReader& table, const ContactTable& contact);
void check(TableReader& table, const MotionTable& motion);
void check(TableReader& table, const FloorSpectraOptions& spectra);
void check(TableReader& table, const StageTable& stage);
void check(TableReader& table, const OutputOptions& output);
void check(TableReader& table, const CalibrationParameterTable& parameter);
void check(TableReader& table, const CalibrationTargetTable& target);
void check(TableReader& table, const CalibrationTable& calibration);

}  // namespace nsframe
