#include "simpletools.h"
#include "propeller1.h"

int main() {
  while (1) {
    int acceleration = getpin(5);
    togglepin(6);
    pause(acceleration);
  }
}
