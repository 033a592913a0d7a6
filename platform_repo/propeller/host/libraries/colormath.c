/* colormath.h. Source: libcolormath/remapColor.c. */
#include "colormath.h"

int remapColor888to565(int c) { return (c >> 8 & 0xF800) | (c >> 5 & 0x07E0) | (c >> 3 & 0x001F); }
