extern int32_t total, table[4], step; __attribute__((weak)) __typeof__(total) total; __attribute__((weak)) __typeof__(table) table;
void work(void);
