#include "adapter.h"

void setup() {}

void loop() { turn(3); }
