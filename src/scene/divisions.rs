pub const MOST_DIVISIONS: u32 = 200;
