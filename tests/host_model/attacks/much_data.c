#include "attack.h"
static char much[1 << 30];
char *use = much;
#include "body.h"
