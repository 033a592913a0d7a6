#include "simpletools.h"
#include "eyes.h"

int look(int pin) { return input(pin) * 10; }
