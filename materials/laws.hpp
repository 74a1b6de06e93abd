// The registry of uniaxial laws: a new one is its header (law.hpp says what it holds), its two entries here and a test.
// The includes are without guard on purpose: the SIMD kernel reads them once for every instruction set.
#include "materials/bouc_wen.hpp"
#include "materials/concrete01.hpp"
#include "materials/concrete02.hpp"
#include "materials/concrete04.hpp"
#include "materials/elastic.hpp"
#include "materials/elastic_pp.hpp"
#include "materials/elastic_pp_gap.hpp"
#include "materials/ent.hpp"
#include "materials/hardening.hpp"
#include "materials/hysteretic.hpp"
#include "materials/imk_bilin.hpp"
#include "materials/steel01.hpp"
#include "materials/steel01_isotropic.hpp"
#include "materials/steel02.hpp"
// wrappers
#include "materials/fatigue.hpp"
#include "materials/initial.hpp"
#include "materials/min_max.hpp"
#include "materials/parallel.hpp"
#include "materials/series.hpp"
// rate-dependent
#include "materials/viscous.hpp"
#include "materials/viscous_damper.hpp"

#ifndef NSFRAME_MATERIALS_LAWS
#define NSFRAME_MATERIALS_LAWS

#include <variant>

namespace nsframe {

// The order is that of the reference of scene files.
using UniaxialLaw = std::variant<  //
    Elastic,                       //
    ElasticPP,                     //
    ElasticPPGap,                  //
    ENT,                           //
    Hardening,                     //
    Steel01,                       //
    Steel01Isotropic,              //
    Steel02,                       //
    Concrete01,                    //
    Concrete02,                    //
    Concrete04,                    //
    Hysteretic,                    //
    BoucWen,                       //
    IMKBilin,                      //
    Parallel,                      //
    Series,                        //
    MinMax,                        //
    InitStrain,                    //
    InitStress,                    //
    Fatigue,                       //
    Viscous,                       //
    ViscousDamper>;

}  // namespace nsframe
#endif
