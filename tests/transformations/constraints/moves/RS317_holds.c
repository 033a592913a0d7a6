#include "simpletools.h"
#include "fdserial.h"
/* Characters of texts, and types that say their sign. */
int main(void)
{
  fdserial *port = fdserial_open(9, 8, 0, 9600);
  int c = fdserial_rxCheck(port);
  signed char s = c;
  unsigned char u = c;
  char letter = c;
  if (c != -1 && s >= 0 && u > 200) putChar(c);
  if (letter >= 'a' && letter <= 'z') putChar(letter);
  while (letter != 0) letter = getChar();
}
