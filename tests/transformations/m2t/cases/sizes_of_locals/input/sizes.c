#include "simpletools.h"
#define SIZE 8
enum { ROWS = 2 };

int main()
{
  char line[SIZE + 1];
  int grid[ROWS][3] = {{0}};
  char *names[] = {"left", "right"};
  int n = 2;
  while (1) {
    line[n] = names[0][0];
    grid[1][n] = line[n];
    pause(grid[1][n]);
  }
}
