//# header simplegfx.h
//# unsupported it draws into the memory of a display, which is larger than the RAM of an Uno
