// The board's own number of a pin, by the core's. A pin that its data does not have ends the run.
#pragma once
#include <stdint.h>
extern "C" int32_t apiPin(int number);
