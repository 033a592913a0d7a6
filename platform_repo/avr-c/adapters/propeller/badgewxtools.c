//# header badgewxtools.h
//# unsupported the badge WX has a colour display, an accelerometer, LEDs, touch buttons and infrared on a board of its own; no adapter replaces them
