#include "simpletools.h"
// Grüße
int main()
{
  print("ü\n");
  pause(5);
}
