//# header simplegfx.h
//# unsupported it draws into the memory of a display, which no adapter has
