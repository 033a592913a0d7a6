//# header vgatext.h
//# unsupported the picture is made by a cog at 25 MHz, and no adapter makes it

// ---------------------------------------------------------------- values of the header

//# constant VGA_TEXT_WHITE_BLUE
//#   fidelity: exact
#define VGA_TEXT_WHITE_BLUE 0L

//# constant VGA_TEXT_YELLOW_BROWN
//#   fidelity: exact
#define VGA_TEXT_YELLOW_BROWN 1L

//# constant VGA_TEXT_MAGENTA_BLACK
//#   fidelity: exact
#define VGA_TEXT_MAGENTA_BLACK 2L

//# constant VGA_TEXT_GREY_WHITE
//#   fidelity: exact
#define VGA_TEXT_GREY_WHITE 3L

//# constant VGA_TEXT_CYAN_DARKCYAN
//#   fidelity: exact
#define VGA_TEXT_CYAN_DARKCYAN 4L

//# constant VGA_TEXT_GREEN_WHITE
//#   fidelity: exact
#define VGA_TEXT_GREEN_WHITE 5L

//# constant VGA_TEST_RED_PINK
//#   fidelity: exact
#define VGA_TEST_RED_PINK 6L

//# constant VGA_TEXT_CYAN_BLUE
//#   fidelity: exact
#define VGA_TEXT_CYAN_BLUE 7L

//# constant VGA_TEXT_COLORS
//#   fidelity: exact
#define VGA_TEXT_COLORS 8L

//# constant VGA_TEXT_PAL_WHITE_BLUE
//#   fidelity: exact
#define VGA_TEXT_PAL_WHITE_BLUE 0L

//# constant VGA_TEXT_PAL_YELLOW_BROWN
//#   fidelity: exact
#define VGA_TEXT_PAL_YELLOW_BROWN 2L

//# constant VGA_TEXT_PAL_MAGENTA_BLACK
//#   fidelity: exact
#define VGA_TEXT_PAL_MAGENTA_BLACK 4L

//# constant VGA_TEXT_PAL_GREY_WHITE
//#   fidelity: exact
#define VGA_TEXT_PAL_GREY_WHITE 6L

//# constant VGA_TEXT_PAL_CYAN_DARKCYAN
//#   fidelity: exact
#define VGA_TEXT_PAL_CYAN_DARKCYAN 8L

//# constant VGA_TEXT_PAL_GREEN_WHITE
//#   fidelity: exact
#define VGA_TEXT_PAL_GREEN_WHITE 10L

//# constant VGA_TEST_PAL_RED_PINK
//#   fidelity: exact
#define VGA_TEST_PAL_RED_PINK 12L

//# constant VGA_TEXT_PAL_CYAN_BLUE
//#   fidelity: exact
#define VGA_TEXT_PAL_CYAN_BLUE 14L

//# constant VGA_TEXT_COLS
//#   fidelity: exact
#define VGA_TEXT_COLS 30L

//# constant VGA_TEXT_ROWS
//#   fidelity: exact
#define VGA_TEXT_ROWS 14L
