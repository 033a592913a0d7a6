//# header il3820.h
//# unsupported the picture of the e-paper display takes 5 KB of RAM, and no adapter draws it

// ---------------------------------------------------------------- values of the header

//# constant BLACK
//#   fidelity: exact
#define BLACK 0L

//# constant WHITE
//#   fidelity: exact
#define WHITE 1L

//# constant INVERSE
//#   fidelity: exact
#define INVERSE 2L

//# constant IL3820_DRIVER_OUTPUT
//#   fidelity: exact
#define IL3820_DRIVER_OUTPUT 0x01L

//# constant IL3820_BOOSTER_SOFT_START
//#   fidelity: exact
#define IL3820_BOOSTER_SOFT_START 0x0CL

//# constant IL3820_GATE_SCAN_START
//#   fidelity: exact
#define IL3820_GATE_SCAN_START 0x0FL

//# constant IL3820_DEEP_SLEEP_MODE
//#   fidelity: exact
#define IL3820_DEEP_SLEEP_MODE 0x10L

//# constant IL3820_DATA_ENTRY_MODE
//#   fidelity: exact
#define IL3820_DATA_ENTRY_MODE 0x11L

//# constant IL3820_SW_RESET
//#   fidelity: exact
#define IL3820_SW_RESET 0x12L

//# constant IL3820_TEMPERATURE_SENSOR
//#   fidelity: exact
#define IL3820_TEMPERATURE_SENSOR 0x1AL

//# constant IL3820_MASTER_ACTIVATION
//#   fidelity: exact
#define IL3820_MASTER_ACTIVATION 0x20L

//# constant IL3820_DISPLAY_UPDATE_1
//#   fidelity: exact
#define IL3820_DISPLAY_UPDATE_1 0x21L

//# constant IL3820_DISPLAY_UPDATE_2
//#   fidelity: exact
#define IL3820_DISPLAY_UPDATE_2 0x22L

//# constant IL3820_WRITE_RAM
//#   fidelity: exact
#define IL3820_WRITE_RAM 0x24L

//# constant IL3820_WRITE_VCOM_REGISTER
//#   fidelity: exact
#define IL3820_WRITE_VCOM_REGISTER 0x2CL

//# constant IL3820_WRITE_LUT_REGISTER
//#   fidelity: exact
#define IL3820_WRITE_LUT_REGISTER 0x32L

//# constant IL3820_SET_DUMMY_LINE_PERIOD
//#   fidelity: exact
#define IL3820_SET_DUMMY_LINE_PERIOD 0x3AL

//# constant IL3820_SET_GATE_TIME
//#   fidelity: exact
#define IL3820_SET_GATE_TIME 0x3BL

//# constant IL3820_BORDER_WAVEFORM_CONTROL
//#   fidelity: exact
#define IL3820_BORDER_WAVEFORM_CONTROL 0x3CL

//# constant IL3820_SET_RAM_X_ADDRESS_POSITION
//#   fidelity: exact
#define IL3820_SET_RAM_X_ADDRESS_POSITION 0x44L

//# constant IL3820_SET_RAM_Y_ADDRESS_POSITION
//#   fidelity: exact
#define IL3820_SET_RAM_Y_ADDRESS_POSITION 0x45L

//# constant IL3820_SET_RAM_X_ADDRESS_COUNTER
//#   fidelity: exact
#define IL3820_SET_RAM_X_ADDRESS_COUNTER 0x4EL

//# constant IL3820_SET_RAM_Y_ADDRESS_COUNTER
//#   fidelity: exact
#define IL3820_SET_RAM_Y_ADDRESS_COUNTER 0x4FL

//# constant IL3820_TERMINATE_FRAME_READ_WRITE
//#   fidelity: exact
#define IL3820_TERMINATE_FRAME_READ_WRITE 0xFFL
