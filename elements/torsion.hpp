// Saint-Venant torsion constants [m4] of plain shapes; dimensions in m.
#pragma once

namespace nsframe {

// Solid rectangle, series solution to rounding.
double rectangle_torsion(double a, double b);

// Closed rectangular tube with rounded corners, of the mean of their outer and inner radius: EN 10210-2, annex A
// (Bredt's formula and the wall's own constant).
double tube_torsion(double depth, double width, double thickness, double mean_radius);

// Angle with root radius r: two rectangles and the junction's inscribed circle (El Darwish and Johnston 1965).
double angle_torsion(double depth, double width, double thickness, double root_radius);

}  // namespace nsframe
