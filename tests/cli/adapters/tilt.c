#include "simpletools.h"
#include "s3.h"

int main() {
  while (1) {
    int acceleration = s3_ping(5);
    s3_setVolume(6);
    pause(acceleration);
  }
}
