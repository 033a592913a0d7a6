#include <stdio.h>
#define LAST 6
enum side { LEFT, RIGHT = 3, TOP };
struct point { int x, y; const char *name; short list[3]; };
int table[8] = { [2] = 50000, 7, [LAST] = 60000 };
int sides[] = { [RIGHT] = 1, [TOP] = 2 };
unsigned char ranges[10] = { [1 ... 3] = 200, [LAST + 1] = 9 };
struct point here = { .y = 70000, .list = { [1] = -5 } };
struct point both[2] = { [1] = { .x = 3, .name = "b" } };
struct point plain = { .x = 1, .y = 2 };
static const char *words[] = { [LEFT] = "left", [RIGHT] = "right" };
int main()
{
  int i, inner[4] = { [3] = 90000 };
  for (i = 0; i < 8; i++) printf("%d ", table[i]);
  for (i = 0; i < (int)(sizeof sides / sizeof sides[0]); i++) printf("%d ", sides[i]);
  for (i = 0; i < 10; i++) printf("%d ", ranges[i]);
  printf("\n%d %d %d %d\n", here.x, here.y, here.list[1], here.list[2]);
  printf("%d %d %s %d\n", both[0].x, both[1].x, both[1].name, both[1].y);
  printf("%d %d %s %s\n", plain.x, plain.y, words[0], words[3]);
  printf("%d %d\n", inner[0], inner[3]);
  return 0;
}
