#include <stdio.h>
struct p { int x, y; };
struct deep { struct p at; int list[4]; const char *name; };
struct p list[] = { [1] = {1, 2}, [0] = {.x = 9} };
struct p rev = { .y = 5, .x = 70000 };
int t[5] = { [3] = 3, [1] = 1, 2, [0] = 50000 };
struct deep d = { .name = "n", .at.y = 4, .list[2] = 7, .at.x = 1 };
struct deep e = { .list = { [3] = 1, [0] = 2 }, .at = { .y = 1, .x = 2 } };
int twice[3] = { [0] = 1, [0] = 2, [2] = 5 };
int grid[2][2] = { [1] = { 3, 4 }, [0] = { [1] = 2, [0] = 1 } };
int grid2[2][2] = { [1][0] = 3, [0][1] = 4 };
union u { int i; float f; char c[4]; };
union u one = { .f = 1.5f };
int main()
{
  int i;
  struct p local = { .y = 1, .x = 2 };
  struct p arr[2] = { [1].y = 5, [0].x = 3 };
  for (i = 0; i < 2; i++) printf("%d %d\n", list[i].x, list[i].y);
  printf("%d %d\n", rev.x, rev.y);
  for (i = 0; i < 5; i++) printf("%d ", t[i]);
  printf("\n%s %d %d %d\n", d.name, d.at.x, d.at.y, d.list[2]);
  printf("%d %d %d %d\n", e.at.x, e.at.y, e.list[0], e.list[3]);
  printf("%d %d\n", twice[0], twice[2]);
  printf("%d %d %d %d\n", grid[0][0], grid[0][1], grid[1][0], grid[1][1]);
  printf("%d %d\n", grid2[0][1], grid2[1][0]);
  printf("%d\n", (int)(one.f * 2));
  printf("%d %d %d %d %d\n", local.x, local.y, arr[0].x, arr[1].y, (int)(sizeof list / sizeof *list));
  return 0;
}
