#include "simpletools.h"

static int cells[4];
static const int fixed[2] = {1, 2};
static const char *const words = "words";

int main(void)
{
  int *none = 0, *nowhere = (int *)0, *end = (int *)-1;
  void *mark = (void *)7;
  const char *text = (const char *)"text";
  unsigned place = (unsigned)cells;
  int *again = (int *)place;
  int *first = (int *)fixed, *second = (int *)(int)&fixed[1], *third = (int *)words;
  again = *first + *second + *third ? (int *)main : 0;
  if (none == (int *)1 || again == end) print("%d", *(int *)&cells[1]);
  *(volatile unsigned *)&cells[2] = *(int *)(place + 4);
  ((char *)cells)[1] = nowhere == mark && text[0];
}
