int count;
int left, right;
int st_timeout = 250;
int later(int n) { left = n; return count + right; }
