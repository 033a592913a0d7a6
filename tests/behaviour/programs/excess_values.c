#include <stdio.h>
#define SENSORS 2
#define NONE 0
const int halt[SENSORS] = {12, 13, 14, 15,};
const int none[NONE] = {8, 20};
static long gone[NONE] = {0};
struct point { int x, y; };
struct point p = {1, 2, 3};
struct point list[2] = {{4, 5, 6}, {7}, {8, 9}};
int rows[2][2] = {{1, 2, 3}, {4, 5}, {6}};
int flat[2][2] = {1, 2, 3, 4};
char name[3] = "abcdef";
char letters[2] = {'a', 'b', 'c'};
int one = {5, 6};
struct line { struct point from, to; int v[2]; } l = {{1, 2}, {3, 4, 5}, {6, 7, 8}, 9};
struct named { char n[4]; int k; } nn = {"abc", 3, 4};
int main(void) {
  printf("%d %d %d %d\n", halt[0], halt[1], (int)sizeof none, (int)sizeof gone);
  printf("%d %d %d %d %d %d\n", p.x, p.y, list[0].x, list[0].y, list[1].x, list[1].y);
  printf("%d %d %d %d %d %d %d %d\n", rows[0][0], rows[0][1], rows[1][0], rows[1][1], flat[0][0], flat[0][1], flat[1][0], flat[1][1]);
  printf("%c%c%c %c%c %d\n", name[0], name[1], name[2], letters[0], letters[1], one);
  printf("%d %d %d %d %d %d %s %d\n", l.from.x, l.from.y, l.to.x, l.to.y, l.v[0], l.v[1], nn.n, nn.k);
  return 0;
}
