#include "simpletools.h"

int main()
{
  int table[2][3] =   /* rows */
  {
    {1, 2, 3},        // first
    {4, 5, 6}         // second
  };                  // end of table
  int
    index             // where
    = 0;
  while (1) {
    index = (index + 1) % 3;
    pause(table[1][index]);
  }
}
