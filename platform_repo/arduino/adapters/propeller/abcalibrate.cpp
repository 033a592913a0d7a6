//# header abcalibrate.h
// Calibration of the ActivityBot's drive. Read from Simple-Libraries 1cc167c10, Learn/Simple Libraries/Robotics/ActivityBot/libabcalibrate.
//# task cal_activityBot the calibration of the source's drive is a table of its EEPROM, and the drive here reads none: measure the servos, and put their table into robosmi.toml, [servos]
//# task cal_displayData the calibration of the source's drive is a table of its EEPROM, and the drive here reads none: measure the servos, and put their table into robosmi.toml, [servos]
//# task cal_displayResults the calibration of the source's drive is a table of its EEPROM, and the drive here reads none: measure the servos, and put their table into robosmi.toml, [servos]
//# task cal_servoPins the calibration of the source's drive is a table of its EEPROM, and the drive here reads none: measure the servos, and put their table into robosmi.toml, [servos]
//# task cal_encoderPins the calibration of the source's drive is a table of its EEPROM, and the drive here reads none: measure the servos, and put their table into robosmi.toml, [servos]
