#include "simpletools.h"
#include "shared.h"
int speed = 4;
int shared;
extern int limits[2];
int above = 5;
static int own(void) { return 2; }
void begin(void) { pause(own()); }
void pace(void) { pause(2); }
void end(void) { pause(limits[1]); }
