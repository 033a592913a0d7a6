#include "sensor.h"
void wander();
