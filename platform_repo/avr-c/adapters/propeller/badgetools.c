//# header badgetools.h
//# unsupported the badge has a display of 128 by 64 points, an accelerometer, LEDs, touch buttons and infrared on a board of its own; no adapter replaces them
