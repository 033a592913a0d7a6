#include "simpletools.h"
#include "state.h"

void tick(void) { pause(counter + limit); }
