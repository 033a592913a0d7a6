#include <stdio.h>
#include <stdlib.h>
struct motor { enum { HALT, ON = 3 } state; int speed; };
struct motor left = { ON, 40000 };
struct wheel { enum mode { SLOW, FAST } mode; union { int i; char c; }; };
typedef struct { enum { RED, GREEN } colour; struct inner { int k; } in; } Lamp;
struct outer { struct point { int a; } at; enum side { L, R } side; };
struct point alone = { 40000 };
enum side which = R;
enum { OFF, RUNNING } state;
typedef struct node node;
struct node { int v; node *next; };
int main(void)
{
  struct motor m;
  struct wheel q;
  enum mode mode = SLOW;
  Lamp lamp = { GREEN, { 40000 } };
  struct inner z = { 5 };
  struct outer o = { { 1 }, R };
  struct point *p = &o.at;
  enum { A, B = 40000, C } x = B;
  enum { E, F } y;
  int room[GREEN + 1];
  node first = { 1, 0 }, second = { 40000, &first };
  struct { int pin; } *unnamed = malloc(sizeof(int));
  void *memory = unnamed;
  m.state = HALT;
  m.speed = 2;
  q.mode = FAST;
  q.i = 40000;
  left.state = 0;
  y = 1;
  state = RUNNING;
  lamp.colour = RED;
  lamp.colour++;
  unnamed = memory;
  unnamed->pin = 70000;
  room[GREEN] = 7;
  switch (q.mode) { case SLOW: printf("slow\n"); break; case FAST: printf("fast\n"); break; }
  printf("%d %d %d %d %d\n", (int)left.state, left.speed, (int)m.state, (int)q.mode, q.i);
  printf("%d %d %d %d %d\n", (int)mode, (int)lamp.colour, lamp.in.k, z.k, p->a);
  printf("%d %d %d %d %d\n", alone.a, (int)which, (int)x, C, (int)y);
  printf("%d %d %d %d\n", (int)state, room[1], second.next->v + second.v, unnamed->pin);
  return 0;
}
