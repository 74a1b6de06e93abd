// Every uniaxial law. No include guard on purpose: the SIMD kernel includes it once for every instruction set.
#include "materials/elastic.hpp"
#include "materials/elastic_pp.hpp"
#include "materials/steel01.hpp"
#include "materials/steel02.hpp"
