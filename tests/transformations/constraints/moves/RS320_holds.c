#include "simpletools.h"
#define INA 6
/* Functions for pins, and the program's own names. */
int OUTA;

int main(void)
{
  int CNT = 3;
  OUTA = CNT;
  high(OUTA);
  low(INA);
}
