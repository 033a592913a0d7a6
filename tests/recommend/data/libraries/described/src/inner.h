struct Inner {};
