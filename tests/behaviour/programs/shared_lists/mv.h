int left, right;
int shared_one, both, *pointer;
void move(void);
