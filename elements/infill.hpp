// Masonry infill as an equivalent diagonal strut (Mainstone 1971; FEMA 356, section 7.5.2, equation 7-14).
#pragma once

namespace nsframe {

struct InfillPanel {
  double thickness = 0;          // of the infill [m]
  double E = 0;                  // its modulus [Pa]
  double column_EI = 0;          // bending stiffness of a column in the plane of the panel [N m2]
  double height = 0, length = 0; // clear, of the panel [m]
  double column_height = 0;      // between the centrelines of the beams [m]
};

// lambda_1 h_col, the stiffness of the infill relative to the columns.
double relative_stiffness(const InfillPanel& panel);

// Width of the strut [m]; its thickness and modulus are those of the infill.
double strut_width(const InfillPanel& panel);

}  // namespace nsframe
