//! centrode
