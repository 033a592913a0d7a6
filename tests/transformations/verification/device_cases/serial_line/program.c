/* A serial line of the program's own: each number that comes is answered, and a lamp says whether it is odd. */
#include "simpletools.h"
#include "fdserial.h"

int main() {
  fdserial *line = fdserial_open(9, 8, 0, 9600);
  while (1) {
    int c = fdserial_rxChar(line);
    if (c >= '0' && c <= '9') {
      dprint(line, "got %c\n", c);
      if (c & 1) high(26);
      else low(26);
    }
  }
}
