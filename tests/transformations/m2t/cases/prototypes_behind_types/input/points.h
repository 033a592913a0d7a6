void nothing(void) {}
struct point { int x, y; };
// How far it is
int corners(void) {
  struct point p = {3, 4};
  return far(&p);
}
int far(struct point *p) { return p->x + p->y; }
