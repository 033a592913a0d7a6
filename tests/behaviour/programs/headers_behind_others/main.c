#include <stdio.h>
#include <string.h>
#include "queue.h"
#include "route.h"
#include "shown.h"

int main(void)
{
  push(cell(2, 3));
  push(cell(300, 400));
  printf("%d %d\n", longest(), steps(&last));
  show(best());
  return 0;
}
