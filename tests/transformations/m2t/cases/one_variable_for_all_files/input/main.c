#include "simpletools.h"
#include <stdlib.h>

int count;
int left, right = 5;
typedef struct step *step;
typedef struct { int at; } place;
struct step { place place; step next; };
int sum(int n, int list[n]);
int later();

int sum(int n, int list[n])
{
  int total = 0;
  while (n--) total += list[n];
  return total;
}

int main()
{
  unsigned char text[8] = "70000";
  int few[2] = { 1, 2 };
  step first = malloc(sizeof(struct step));
  first->place.at = atoi(text);
  first->next = NULL;
  count = sum(2, few) + later(3) + first->place.at;
  print("%d %d %d %d\n", count, left, right, st_timeout);
  return 0;
}
