//# header abcalibrate360.h
// Calibration of the ActivityBot 360's drive. Read from Simple-Libraries 1cc167c10, Learn/Simple Libraries/Robotics/ActivityBot360/libabcalibrate360.
//# task cal_activityBot the calibration of the source's drive is a transfer function in its EEPROM, and the drive here takes the library's standard one: set another with servo360_setTransferFunction
//# task cal_clear the calibration of the source's drive is a transfer function in its EEPROM, and the drive here takes the library's standard one: set another with servo360_setTransferFunction
//# task cal_displayData the calibration of the source's drive is a transfer function in its EEPROM, and the drive here takes the library's standard one: set another with servo360_setTransferFunction
//# task cal_displayResults the calibration of the source's drive is a transfer function in its EEPROM, and the drive here takes the library's standard one: set another with servo360_setTransferFunction
//# task cal_encoderPins the calibration of the source's drive is a transfer function in its EEPROM, and the drive here takes the library's standard one: set another with servo360_setTransferFunction
//# task cal_getEepromPins the calibration of the source's drive is a transfer function in its EEPROM, and the drive here takes the library's standard one: set another with servo360_setTransferFunction
//# task cal_servoPins the calibration of the source's drive is a transfer function in its EEPROM, and the drive here takes the library's standard one: set another with servo360_setTransferFunction
//# task cal_supply5V the calibration of the source's drive is a transfer function in its EEPROM, and the drive here takes the library's standard one: set another with servo360_setTransferFunction
