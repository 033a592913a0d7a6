//# header adcACpropab.h
// The board's converter, read all the time by a cog. Read from Simple-Libraries 1cc167c10, Learn/Simple Libraries/Convert/libadcACpropab.
//# task adc_start a cog fills its array with voltages all the time there: take the call out, and fill the array where the program reads it, with analogRead(A0) * 4 for each channel of the pattern
//# task adc_stop no cog reads the converter here: take the call out
