#include "simpletools.h"
int values[4];
int place;
enum colour { RED, GREEN } shown;

int main(void)
{
  place = 64 + sizeof(int);  // RS315
  for (int i = 0; i < sizeof(values); i++) pause(i);  // RS315
  print("%d", sizeof(shown));  // RS315
  print("%d", (int)sizeof(char *));  // RS315
}
