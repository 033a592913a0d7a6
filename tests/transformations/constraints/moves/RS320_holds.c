#include "simpletools.h"
/* Functions for pins, and the program's own names. */
int OUTA;

int main(void)
{
  int CNT = 3;
  OUTA = CNT;
  high(OUTA);
}
