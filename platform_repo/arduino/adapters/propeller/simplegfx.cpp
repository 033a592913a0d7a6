//# header simplegfx.h
//# unsupported it draws into the memory of a display, which no adapter has

// ---------------------------------------------------------------- values of the header

//# constant SMALL
//#   fidelity: exact
#define SMALL 1L

//# constant MEDIUM
//#   fidelity: exact
#define MEDIUM 2L

//# constant LARGE
//#   fidelity: exact
#define LARGE 3L

//# constant FONT_SANS
//#   fidelity: exact
#define FONT_SANS 0L

//# constant FONT_SERIF
//#   fidelity: exact
#define FONT_SERIF 1L

//# constant FONT_SCRIPT
//#   fidelity: exact
#define FONT_SCRIPT 2L

//# constant FONT_BUBBLE
//#   fidelity: exact
#define FONT_BUBBLE 3L

//# constant INTF_SPI_NO_BUFFER
//#   fidelity: exact
#define INTF_SPI_NO_BUFFER 0b00L

//# constant INTF_SPI_WITH_BUFFER
//#   fidelity: exact
#define INTF_SPI_WITH_BUFFER 0b10L

//# constant INTF_I2C_NO_BUFFER
//#   fidelity: exact
#define INTF_I2C_NO_BUFFER 0b01L

//# constant INTF_I2C_WITH_BUFFER
//#   fidelity: exact
#define INTF_I2C_WITH_BUFFER 0b11L
