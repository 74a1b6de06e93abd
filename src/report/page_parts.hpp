// The parts of the page as texts: the files of src/report/page, which CMake puts into the library.
#pragma once

namespace nsframe::page_parts {

extern const char* const page;    // page.html
extern const char* const style;   // style.css
extern const char* const chart;   // chart.js
extern const char* const view;    // view.js
extern const char* const script;  // page.js

}  // namespace nsframe::page_parts
