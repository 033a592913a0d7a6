/* Which device a remote control speaks to, and the whole code. */
#include "simpletools.h"
#include "sirc.h"

const int EYE = 16;

int main() {
  print("%d\n", sirc_device(EYE));
  pause(120);
  int code = sirc_code(EYE, 12);
  print("%d %d\n", code & 127, code >> 7);
  pause(120);
  print("%d\n", sirc_code(EYE, 7));
  pause(200);
  sirc_setTimeout(100);
  print("%d\n", sirc_device(EYE));
  print("%d\n", pulse_in(EYE, 0));
}
