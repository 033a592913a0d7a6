#include "simpletools.h"

const int goSign    = 27;     // on while running (green)
const int stuckSign = 9;      // blinks when stuck (yellow)
const int warnSign  = 5;      /* amber */
#define wallSign 26           // red
int markSign = 3;             // the white one

int main()
{
  high(goSign);
  low(stuckSign);
  high(warnSign);
  low(wallSign);
  low(markSign);
}
