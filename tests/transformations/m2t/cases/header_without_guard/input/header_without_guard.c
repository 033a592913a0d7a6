#include "wander.h"
#include "sensor.h"
#include "wander.h"

int main() {
  wander();
  return distance() + level();
}

void wander() {}
