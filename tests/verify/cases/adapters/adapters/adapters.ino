#include "adapter.h"
#include "src/deep/counter.h"

void setup() { pinMode(13, OUTPUT); }

void loop() { blink(13, count()); }
