# Links into the source tree lead nowhere from Doxygen's pages: only their text stays.
s,!?\[([^]]*)\]\((docs|config|srv|msg|test|include|\.github)[^)]*\),\1,g
