#include "simpletools.h"
#include "turn.h"

void turn(int degrees) { pause(degrees); }
