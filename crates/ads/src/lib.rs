//! rasray: ads.
