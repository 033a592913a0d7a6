extern int total, table[4], step;
void work(void);
