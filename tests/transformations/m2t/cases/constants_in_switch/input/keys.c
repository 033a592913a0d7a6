#include "simpletools.h"
#include "sirc.h"

int main()
{
  char line[MAX_LINE];
  while (1) {
    switch (sirc_key(10)) {
      case CH_UP: high(1); break;
      case CH_DN: low(1); break;
      case VOL_UP: line[0] = 'v'; break;
    }
  }
}
