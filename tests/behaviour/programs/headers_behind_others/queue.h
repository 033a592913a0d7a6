typedef struct { int x, y; } place;
struct entry { place at; int before; };
struct entry queue[4], last;
int used;

void push(struct entry e) { e.before = used - 1; queue[used++] = e; last = e; }
struct entry get(int number) { return queue[number]; }
